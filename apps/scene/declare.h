// Declares entries section by section, each bound to the member of the scene that holds its value: the value
// that the member has beforehand is the default.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/parameters.h"
#include "apps/scene/values.h"

namespace platen::apps {

class Section {
public:
  // Members given to the functions below must live until parameters.release().
  Section(Parameters &parameters, std::string name) : parameters_(parameters), name_(std::move(name)) {}

  // A number with its dimension; NaN beforehand: there is no default, and "" means not given.
  void quantity(const std::string &key, double &to, const std::string &si_unit, const Range &range,
                const std::string &documentation);
  // A number without dimension ("20 %" is 0.2).
  void number(const std::string &key, double &to, const Range &range, const std::string &documentation) {
    quantity(key, to, "1", range, documentation);
  }
  template <class Integer>
  void integer(const std::string &key, Integer &to, double low, double high,
               const std::string &documentation) {
    const Range range = between(low, high);
    declare(key, std::to_string(to), "", "whole, " + range.text(), documentation,
            [&to, range](const std::string &text) { to = static_cast<Integer>(read_integer(text, range)); });
  }
  void flag(const std::string &key, bool &to, const std::string &documentation);
  void text(const std::string &key, std::string &to, const std::string &documentation);
  // A path; what is stored is the text, resolved later against the folder of the scene.
  void file(const std::string &key, std::string &to, const std::string &documentation);
  void interval(const std::string &key, Interval &to, const std::string &documentation);
  void gap(const std::string &key, Gap &to, const std::string &documentation);
  void stiffness(const std::string &key, Stiffness &to, bool bulk_allowed, const std::string &documentation);
  void list(const std::string &key, std::vector<double> &to, const std::string &si_unit, const Range &range,
            const std::string &documentation);
  void gaps(const std::string &key, std::vector<Gap> &to, const std::string &documentation);
  void domains(const std::string &key, std::vector<DomainSize> &to, const std::string &documentation);
  void study_surfaces(const std::string &key, std::vector<StudySurface> &to,
                      const std::string &documentation);
  void qualities(const std::string &key, std::vector<Quality> &to, const std::string &documentation);
  // "Section/Key = value" of other entries, as texts; whether there are such entries is not looked at.
  void assignments(const std::string &key, std::vector<std::string> &to, const std::string &documentation);
  // A range for a number of summary.json; what is given is kept in `to`, once for each key.
  void expectation(const std::string &key, std::vector<Expectation> &to, const std::string &unit,
                   const std::string &documentation);
  // The same for a word of summary.json: which of `words` it may be.
  void expected_words(const std::string &key, std::vector<Expectation> &to,
                      const std::vector<std::string> &words, const std::string &documentation);
  // One word of several.
  template <class Enum>
  void word(const std::string &key, Enum &to, const std::vector<std::pair<std::string, Enum>> &words,
            const std::string &documentation) {
    std::vector<std::string> names;
    std::string by_default;
    for (const auto &[name, value] : words) {
      names.push_back(name);
      if (value == to) by_default = name;
    }
    declare(key, by_default, "", joined(names), documentation,
            [&to, words, names](const std::string &text) { to = words[read_word(text, names)].second; });
  }

private:
  void declare(const std::string &key, const std::string &default_text, const std::string &unit,
               const std::string &allowed, const std::string &documentation,
               std::function<void(const std::string &)> read, bool is_file = false);

  Parameters &parameters_;
  std::string name_;
};

// All entries of a scene file, bound to a scene that must stay in place until parameters.release().
void declare_scene(Parameters &parameters, Scene &scene);

} // namespace platen::apps
