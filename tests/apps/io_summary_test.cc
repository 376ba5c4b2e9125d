#include <limits>

#include "apps/io/errors.h"
#include "apps/io/file.h"
#include "apps/io/machine.h"
#include "apps/io/summary.h"
#include "io_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class Summary : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "summary.json";
};

TEST_F(Summary, keeps_keys_in_order_and_numbers_to_the_bit) {
  Json summary;
  summary["status"] = "done";
  summary["app"] = "platen-compress";
  summary["strength_pa"] = 1e8 / 3;
  summary["effects"] = {"parallel bond", "coulomb"};
  summary["stage_seconds"]["bonds"] = 0.1;
  write_summary(path_, summary);
  const Json back = Json::parse(content_of(path_));
  EXPECT_EQ(back, summary);
  EXPECT_EQ(back["strength_pa"].get<double>(), 1e8 / 3);
  std::vector<std::string> keys;
  for (const auto &[key, value] : back.items())
    keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"status", "app", "strength_pa", "effects", "stage_seconds"}));
}

TEST_F(Summary, says_null_for_what_was_not_measured) {
  Json summary;
  summary["poisson_ratio"] = std::numeric_limits<double>::quiet_NaN();
  summary["rate"] = std::numeric_limits<double>::infinity();
  summary["cone_top"] = nullptr;
  write_summary(path_, summary);
  const Json back = Json::parse(content_of(path_));
  for (const char *key : {"poisson_ratio", "rate", "cone_top"})
    EXPECT_TRUE(back[key].is_null()) << key;
}

TEST_F(Summary, is_whole_even_with_text_that_is_not) {
  Json summary;
  summary["scene"] = "caf\xe9"; // Latin-1
  write_summary(path_, summary);
  EXPECT_EQ(Json::parse(content_of(path_))["scene"], "caf\xef\xbf\xbd");
}

TEST_F(Summary, on_a_full_disk_leaves_the_former_one) {
  write_summary(path_, {{"status", "done"}});
  const std::string before = content_of(path_);
  fs::create_symlink("/dev/full", part_path(path_));
  const std::string text = message_of<OutputError>([&] { write_summary(path_, {{"status", "failed"}}); });
  EXPECT_TRUE(contains(text, "No space left")) << text;
  EXPECT_EQ(content_of(path_), before);
  EXPECT_FALSE(fs::exists(fs::symlink_status(part_path(path_))));
}

TEST_F(Summary, memory_at_its_peak_covers_what_was_in_use) {
  const std::uint64_t before = peak_memory_bytes();
  const std::size_t block = std::size_t{64} << 20;
  {
    std::vector<char> used(block + before, 1); // every page is touched
    EXPECT_EQ(used[block], 1);
  }
  EXPECT_GE(peak_memory_bytes(), before + block);
  EXPECT_GT(this_machine().cores, 0);
  EXPECT_GT(this_machine().memory_bytes, peak_memory_bytes());
}

class StreamAside : public ScratchFolder {};

TEST_F(StreamAside, is_whole_or_not_there) {
  const fs::path path = folder_ / "platens.vtu";
  write_stream_aside(path, [](std::ostream &out) { out << "whole"; });
  EXPECT_EQ(content_of(path), "whole");
  EXPECT_THROW(write_stream_aside(path,
                                  [](std::ostream &out) {
                                    out << "half";
                                    throw std::domain_error("body");
                                  }),
               std::domain_error);
  EXPECT_EQ(content_of(path), "whole");
  for (const std::size_t length : {std::size_t{1}, std::size_t{1000000}}) { // buffered, and not
    fs::create_symlink("/dev/full", part_path(path));
    const std::string text = message_of<OutputError>(
        [&] { write_stream_aside(path, [&](std::ostream &out) { out << std::string(length, 'x'); }); });
    EXPECT_TRUE(contains(text, "No space left")) << text;
    EXPECT_EQ(content_of(path), "whole");
  }
  // Nor do words of a writer that looks at its stream reach the user.
  fs::create_symlink("/dev/full", part_path(path));
  const auto looks = [](std::ostream &out) {
    if (!(out << std::string(1000000, 'x')).flush()) throw std::domain_error("an input/output error");
  };
  const std::string text = message_of<OutputError>([&] { write_stream_aside(path, looks); });
  EXPECT_TRUE(contains(text, "No space left")) << text;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

} // namespace
} // namespace platen::apps
