// Our reader of .prm and deal.II's own agree on the grammar, and each reads what the other's side writes.
#include <deal.II/base/parameter_handler.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/bonds/pair_section.h"
#include "apps/programs.h"
#include "apps/scene/declare.h"
#include "apps/scene/scene_writer.h"

namespace platen::apps {
namespace {

std::vector<std::string> parts_of(const std::string &path) {
  std::vector<std::string> parts;
  std::istringstream stream(path);
  for (std::string part; std::getline(stream, part, '/');)
    parts.push_back(part);
  return parts;
}

// The value that a text gives to an entry, by deal.II; every entry of ours is declared, as plain text.
std::vector<std::string> values_by_deal_ii(const std::string &text) {
  Scene scene;
  Parameters parameters;
  declare_scene(parameters, scene);
  dealii::ParameterHandler handler;
  for (const Entry &entry : parameters.entries()) {
    auto parts = parts_of(entry.path);
    const std::string key = parts.back();
    parts.pop_back();
    for (const auto &part : parts)
      handler.enter_subsection(part);
    handler.declare_entry(key, entry.default_text, dealii::Patterns::Anything());
    for (std::size_t k = 0; k < parts.size(); ++k)
      handler.leave_subsection();
  }
  handler.parse_input_from_string(text);
  std::vector<std::string> values;
  for (const Entry &entry : parameters.entries()) {
    auto parts = parts_of(entry.path);
    const std::string key = parts.back();
    parts.pop_back();
    values.push_back(entry.path + " = " + handler.get(parts, key));
  }
  return values;
}

std::vector<std::string> values_by_us(const std::string &text) {
  Scene scene;
  Parameters parameters;
  declare_scene(parameters, scene);
  parameters.apply(prm_assignments(text, "text.prm"));
  parameters.throw_faults();
  std::vector<std::string> values;
  for (const Entry &entry : parameters.entries())
    values.push_back(entry.path + " = " + entry.text);
  return values;
}

TEST(ParameterHandler, both_readers_see_the_same_values) {
  const char *texts[] = {
      "",
      "subsection Bond\n  set Modulus = 4 GPa\nend\n",
      "SUBSECTION Bond\n\tSET Modulus=4 GPa # comment \\\n  set Gap =0.1 R_min\nEND",
      "subsection Bond # comment\n set Modulus = 4 \\\n   GPa\nend # comment\n",
      "subsection Bond\n set Modulus = 4\\\n  e9\n\\\n\n set Gap = 0.1 R_min\nend\n",
      "subsection Platens\n subsection Top\n  set Stress = 1 MPa\n end\n set Overhang = 2\nend\n",
      "subsection Scene\n  set Title = a = \"b\"  c ; 'd' { }\\\n e\nend\n",
      "subsection Scene\n  set Title = x\nend\nsubsection Bond\nend\nsubsection Scene\n set Seed = "
      "3\nend\r\n"};
  for (const char *text : texts)
    EXPECT_EQ(values_by_us(text), values_by_deal_ii(text)) << text;
}

TEST(ParameterHandler, reads_what_we_write) {
  const std::string text = scene_text(default_scene(program("compress")), ".");
  EXPECT_EQ(values_by_deal_ii(text), values_by_us(text));
  std::ostringstream documented;
  const Scene scene = default_scene(program("compress"));
  const auto &entries = scene.parameters->entries();
  write_prm({entries.begin(), entries.end()}, true, documented);
  EXPECT_EQ(values_by_deal_ii(documented.str()), values_by_us(text));
}

TEST(ParameterHandler, writes_json_that_we_read) {
  dealii::ParameterHandler handler;
  handler.enter_subsection("Pair test");
  handler.declare_entry("Modulus list", "", dealii::Patterns::Anything());
  handler.set("Modulus list", "1 GPa, 2 GPa");
  handler.leave_subsection();
  for (const auto style : {dealii::ParameterHandler::JSON, dealii::ParameterHandler::ShortJSON}) {
    std::ostringstream text;
    handler.print_parameters(text, style);
    Scene scene;
    Parameters parameters;
    program("bonds").declare(parameters, scene);
    parameters.apply(json_assignments(text.str(), "text.json"));
    parameters.throw_faults();
    EXPECT_EQ(scene.own<PairTest>().moduli, (std::vector<double>{1e9, 2e9})) << text.str();
  }
}

} // namespace
} // namespace platen::apps
