// What is listed of the state in a checkpoint.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "apps/output/checkpoint_folder.h"
#include "apps/output/state_listing.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {
namespace {

struct Spheres {
  Table table;
  Column<double> &radius = table.add<double>("radius", "m");
  double pressure = 2e6;
  std::string reason = "bond 7";
  Spheres() {
    table.resize(3);
    radius[0] = 1, radius[1] = 0.5, radius[2] = 2;
  }
  void describe(Archive &archive) {
    archive.version(4);
    archive("pressure", pressure, "Pa");
    archive.text("reason", reason);
    archive.table("particles", table);
  }
};

class StateListing : public ScratchFolder {
protected:
  std::filesystem::path keep(const std::string &run, const Spheres &spheres) const {
    write_checkpoint(folder_ / run / "checkpoint", 12,
                     [&](StateSink &to) { save_part(to, "specimen", spheres); });
    return folder_ / run;
  }
};

// With one blank for several.
std::string squeezed(const std::string &text) {
  return std::regex_replace(text, std::regex(" +"), " ");
}

TEST_F(StateListing, every_block_is_listed_with_rows_kind_unit_and_range) {
  std::ostringstream out;
  list_state(keep("run", Spheres()), out);
  const std::string text = squeezed(out.str());
  EXPECT_TRUE(contains(text, "step_000000000012.platen: step 12, 5 blocks, "));
  EXPECT_TRUE(contains(text, "\nspecimen (version 4)\n"));
  EXPECT_TRUE(contains(text, "\nspecimen/pressure 1 float64 Pa 2000000\n"));
  EXPECT_TRUE(contains(text, "\nspecimen/reason 6 text 1 \"bond 7\"\n"));
  EXPECT_TRUE(contains(text, "\nspecimen/particles/radius 3 float64 m 0.5 ... 2\n"));
}

TEST_F(StateListing, numbers_that_are_none_are_counted_beside_the_range) {
  Spheres broken;
  broken.radius[1] = std::nan("");
  std::ostringstream out;
  list_state(keep("run", broken), out);
  EXPECT_TRUE(contains(squeezed(out.str()), "\nspecimen/particles/radius 3 float64 m 1 ... 2 and 1 nan\n"))
      << out.str();
}

TEST_F(StateListing, the_first_difference_of_two_runs_is_told) {
  Spheres other;
  const std::filesystem::path first = keep("first", Spheres()), same = keep("same", Spheres());
  other.radius[1] = 0.25;
  const std::filesystem::path changed = keep("changed", other);
  std::ostringstream out;
  EXPECT_TRUE(compare_states(first, same, out));
  EXPECT_TRUE(contains(out.str(), ": the same to the last bit\n"));
  out.str("");
  EXPECT_FALSE(compare_states(first, changed, out));
  EXPECT_TRUE(contains(out.str(), ": specimen/particles/radius, row 1: 0.5 and 0.25 m\n"));
}

TEST_F(StateListing, a_folder_without_a_checkpoint_is_refused) {
  std::ostringstream out;
  EXPECT_THROW(list_state(folder_ / "none", out), CheckpointError);
}

} // namespace
} // namespace platen::apps::testing
