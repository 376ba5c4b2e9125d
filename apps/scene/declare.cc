#include "apps/scene/declare.h"

#include <algorithm>

namespace platen::apps {
namespace {

// What is given last counts; nothing given is nothing expected.
void keep_one(std::vector<Expectation> &of, const std::string &key, Expectation expectation) {
  expectation.key = key;
  of.erase(std::remove_if(of.begin(), of.end(), [&](const Expectation &e) { return e.key == key; }),
           of.end());
  if (!expectation.text.empty()) of.push_back(std::move(expectation));
}

} // namespace

Declared Section::declare(const std::string &key, const std::string &default_text, const std::string &unit,
                          const std::string &allowed, const std::string &documentation,
                          std::function<void(const std::string &)> read, bool is_file) {
  Entry entry;
  entry.path = name_ + "/" + key;
  entry.default_text = default_text;
  entry.unit = unit;
  entry.allowed = allowed;
  entry.documentation = documentation;
  entry.is_file = is_file;
  entry.read = std::move(read);
  const std::string path = entry.path;
  if (join_ && parameters_.find(path) != nullptr)
    parameters_.join(std::move(entry));
  else
    parameters_.declare(std::move(entry));
  return {parameters_, path};
}

Declared Section::entry(const std::string &key, double &to, const std::string &si_unit, const Range &range,
                        const std::string &documentation) {
  const Allowed allowed = physical(name_ + "/" + key, si_unit, range);
  return declare(
      key, shortest_text(to), si_unit, allowed.text(), documentation,
      [&to, si_unit, allowed](const std::string &text) { to = read_quantity(text, si_unit, allowed); });
}

Declared Section::entry(const std::string &key, bool &to, const std::string &documentation) {
  const Declared declared = declare(key, to ? "on" : "off", "", "on, off", documentation,
                                    [&to](const std::string &text) { to = read_flag(text); });
  parameters_.declared(name_ + "/" + key).words = {"on", "off"};
  return declared;
}

Declared Section::text(const std::string &key, std::string &to, const std::string &documentation) {
  const Declared declared =
      declare(key, to, "", "", documentation, [&to](const std::string &given) { to = given; });
  parameters_.declared(name_ + "/" + key).is_text = true;
  return declared;
}

Declared Section::file(const std::string &key, std::string &to, const std::string &documentation) {
  return declare(
      key, to, "", "path of a file", documentation, [&to](const std::string &given) { to = given; }, true);
}

Declared Section::entry(const std::string &key, Interval &to, const std::string &documentation) {
  return declare(key, text_of(to), "", "steps (a whole number), or a time with its unit; 0 or more",
                 documentation, [&to](const std::string &text) { to = read_interval(text); });
}

Declared Section::entry(const std::string &key, Gap &to, const std::string &documentation) {
  return declare(key, text_of(to), "", gap_allowed, documentation,
                 [&to](const std::string &text) { to = read_gap(text); });
}

Declared Section::stiffness(const std::string &key, Stiffness &to, bool bulk_allowed,
                            const std::string &documentation) {
  return declare(key, text_of(to), "", stiffness_allowed(bulk_allowed), documentation,
                 [&to, bulk_allowed](const std::string &text) { to = read_stiffness(text, bulk_allowed); });
}

Declared Section::entry(const std::string &key, std::vector<double> &to, const std::string &si_unit,
                        const Range &range, const std::string &documentation) {
  const Allowed allowed = physical(name_ + "/" + key, si_unit, range);
  return declare(
      key, "", si_unit, "numbers with commas between them, each " + allowed.text(), documentation,
      [&to, si_unit, allowed](const std::string &text) { to = read_list(text, si_unit, allowed); });
}

Declared Section::expectation(const std::string &key, std::vector<Expectation> &to, const std::string &unit,
                              const std::string &documentation) {
  const Allowed allowed = physical(name_ + "/" + key, unit, any_number());
  return declare(key, "", unit, "\"low ... high\"", documentation,
                 [&to, key, unit, allowed](const std::string &text) {
                   keep_one(to, key, read_expectation(text, unit, allowed));
                 });
}

Declared Section::expected_words(const std::string &key, std::vector<Expectation> &to,
                                 const std::vector<std::string> &words, const std::string &documentation) {
  return declare(
      key, "", "", "with commas between them, any of " + joined(words), documentation,
      [&to, key, words](const std::string &text) { keep_one(to, key, read_expected_words(text, words)); });
}

} // namespace platen::apps
