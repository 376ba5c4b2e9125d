// The list of figures: the page of outputs names all of them with their units, and columns that rows name as
// their own are columns of history.csv.
#include "apps/run/figures.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "apps/scene/parameters.h"
#include "apps/scene/sections.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

// Of docs/outputs.md: what its tables have in the first column, to the units beside it.
std::map<std::string, std::string> names_of_page() {
  std::ifstream page(PLATEN_OUTPUTS_PAGE);
  std::map<std::string, std::string> names;
  const std::regex row("^\\| (`.*?) \\| (.*?) ?\\|.*"), quoted("`([^`]+)`");
  for (std::string line; std::getline(page, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    const std::string first = cells[1], units = cells[2];
    for (std::sregex_iterator name(first.begin(), first.end(), quoted), end; name != end; ++name)
      names[(*name)[1]] += " " + units + ",";
  }
  return names;
}

std::string last_part(const std::string &key) {
  return key.substr(key.rfind('/') + 1);
}

TEST(Figures, stand_on_the_page_of_outputs_with_their_units) {
  const std::map<std::string, std::string> names = names_of_page();
  ASSERT_GT(names.size(), 200u);
  for (const Figure &figure : figures()) {
    const auto whole = names.find(figure.key), part = names.find(last_part(figure.key));
    const auto found = whole != names.end() ? whole : part;
    ASSERT_NE(found, names.end()) << figure.key << " is not on docs/outputs.md";
    EXPECT_TRUE(contains(found->second, " " + figure.unit))
        << figure.key << " is in " << figure.unit << ", the page says";
  }
}

TEST(Figures, are_said_once) {
  std::set<std::string> keys;
  for (const Figure &figure : figures())
    EXPECT_TRUE(keys.insert(figure.key).second) << figure.key;
  for (const char *key : {"strength_pa", "side_stress_at_peak_pa/front", "final_cone_top/half_angle_deg",
                          "acoustic/b_after_error", "crack_planes/largest/share"})
    EXPECT_EQ(keys.count(key), 1u) << key;
}

TEST(Figures, have_columns_of_their_own_that_history_has) {
  std::set<std::string> columns;
  for (const HistoryColumn &column : history_columns())
    columns.insert(column.name);
  std::size_t own = 0;
  for (const Figure &figure : figures()) {
    std::istringstream names(figure.columns);
    for (std::string name; names >> name; ++own)
      EXPECT_EQ(columns.count(name), 1u) << figure.key << " rests on " << name;
  }
  EXPECT_GT(own, 10u);
}

// Numbers but costs, which depend on the machine.
TEST(Figures, are_what_a_scene_may_expect) {
  Parameters declared;
  std::vector<Expectation> expect;
  declare_expect(declared, expect);
  std::set<std::string> entries;
  for (const Entry &entry : declared.entries())
    entries.insert(entry.path);
  for (const Figure &figure : figures())
    EXPECT_EQ(entries.count("Expect/" + figure.key) == 1,
              (figure.is_number() && (figure.needs & of_machine) == 0) ||
                  last_part(figure.key) == "pattern" || figure.key == "final_pattern")
        << figure.key;
  EXPECT_EQ(entries.count("Expect/wall_seconds"), 0u);
  EXPECT_EQ(entries.count("Expect/bending/static_error_effective"), 1u);
}

} // namespace
} // namespace platen::apps
