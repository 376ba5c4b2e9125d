// Declares entries section by section, each bound to the member of the scene that holds its value: the value
// that the member has beforehand is the default. What an entry depends on is said with it: from it follow the
// notes on entries that have no effect, and the refusals of those that are missing.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/parameters.h"
#include "apps/scene/program.h"
#include "apps/scene/values.h"

namespace platen::apps {

struct Scene;

// What is checked when a scene has been read.
struct Situation {
  const Scene &scene;
  const Parameters &parameters;
  const Program &program;

  operator const Scene &() const { return scene; }
  bool loads() const { return program.presses != Presses::nothing; }
  bool rate_by_transits() const; // Loading/Wave crossings sets the rate
  // The program gives the entry to each of its runs, from a list of its own.
  bool given_by_program(const std::string &path) const {
    return program.gives != nullptr && program.gives(scene, parameters, path);
  }
  // A test of the program needs this part, though the scene does not ask for it.
  bool used_by_program(const std::string &part) const {
    return program.uses != nullptr && program.uses(scene, part);
  }
};

inline bool given(double value) {
  return !std::isnan(value);
}

// Whether an entry has one of these words.
bool has_word(const Parameters &parameters, const std::string &path, const std::vector<std::string> &words);

// An entry that has been declared, of which more is said.
class Declared {
public:
  Declared(Entry &entry) : entry_(&entry) {}
  Declared(Parameters &parameters, const std::string &path) : entry_(&parameters.declared(path)) {}

  // It has an effect only where another entry has one of these words; within a section the documentation says
  // so too.
  Declared &only_if(const std::string &path, const std::vector<std::string> &words);
  // It has none where another entry has one of these words.
  Declared &unless(const std::string &path, const std::vector<std::string> &words);
  Declared &only_if(std::function<bool(const Situation &)> holds, const std::string &otherwise);
  // It must be given where another entry has one of these words.
  Declared &needed_if(const std::string &path, const std::vector<std::string> &words);
  // It must be given where `why`, a sentence, is not "".
  Declared &needed_if(std::function<std::string(const Situation &)> why);
  // A word stands for the number that it has beforehand, numbers have to be of the range; where nothing is
  // given that number holds too, but there is no default.
  Declared &or_word(const std::string &word, const Range &otherwise);
  // Takes the place of the documentation.
  Declared &documented(const std::string &documentation);
  // Ends the documentation with " (text).".
  Declared &remark(const std::string &text);
  // The member of the library's struct that it sets.
  Declared &member(const std::string &path); // "loading.ramp"
  // One of a few words.
  Declared &of_words(const std::vector<std::string> &words);

private:
  Entry *entry_;
};

class Section {
public:
  // Members given to the functions below must live until parameters.release(). What an entry reads follows
  // from the member and from what is said of it, as in base/describe.h.
  Section(Parameters &parameters, std::string name) : parameters_(parameters), name_(std::move(name)) {}

  // A number with its dimension; NaN beforehand: there is no default, and "" means not given.
  Declared entry(const std::string &key, double &to, const std::string &si_unit, const Range &range,
                 const std::string &documentation);
  // A number without dimension ("20 %" is 0.2).
  Declared number(const std::string &key, double &to, const Range &range, const std::string &documentation) {
    return entry(key, to, "1", range, documentation);
  }
  Declared entry(const std::string &key, std::vector<double> &to, const std::string &si_unit,
                 const Range &range, const std::string &documentation);
  Declared entry(const std::string &key, int &to, const Range &range, const std::string &documentation) {
    return integer(key, to, range.low, range.high, documentation);
  }
  template <class Integer>
  Declared integer(const std::string &key, Integer &to, double low, double high,
                   const std::string &documentation) {
    const Range range = between(low, high);
    return declare(
        key, std::to_string(to), "", "whole, " + range.text(), documentation,
        [&to, range](const std::string &text) { to = static_cast<Integer>(read_integer(text, range)); });
  }
  Declared entry(const std::string &key, bool &to, const std::string &documentation);
  Declared text(const std::string &key, std::string &to, const std::string &documentation);
  // A path; what is stored is the text, resolved later against the folder of the scene.
  Declared file(const std::string &key, std::string &to, const std::string &documentation);
  Declared entry(const std::string &key, Interval &to, const std::string &documentation);
  Declared entry(const std::string &key, Gap &to, const std::string &documentation);
  Declared entry(const std::string &key, Stiffness &to, const std::string &documentation) {
    return stiffness(key, to, true, documentation);
  }
  Declared stiffness(const std::string &key, Stiffness &to, bool bulk_allowed,
                     const std::string &documentation);
  // What read(text) makes of it; there is no default.
  template <class Value>
  Declared value(const std::string &key, Value &to, const std::string &unit, const std::string &allowed,
                 Value (*read)(const std::string &), const std::string &documentation) {
    return declare(key, "", unit, allowed, documentation,
                   [&to, read](const std::string &text) { to = read(text); });
  }
  // A range for a number of summary.json; what is given is kept in `to`, once for each key.
  Declared expectation(const std::string &key, std::vector<Expectation> &to, const std::string &unit,
                       const std::string &documentation);
  // The same for a word of summary.json: which of `words` it may be.
  Declared expected_words(const std::string &key, std::vector<Expectation> &to,
                          const std::vector<std::string> &words, const std::string &documentation);
  // One word of several.
  template <class Enum>
  Declared entry(const std::string &key, Enum &to, const Words<Enum> &words,
                 const std::string &documentation) {
    std::vector<std::string> names;
    std::string by_default;
    for (const auto &[name, value] : words) {
      names.push_back(name);
      if (value == to && by_default.empty()) by_default = name;
    }
    return declare(
               key, by_default, "", joined(names), documentation,
               [&to, words, names](const std::string &text) { to = words[read_word(text, names)].second; })
        .of_words(names);
  }

  // The same section, of whose entries it is said that they have an effect there alone, or none there (as of
  // one entry: Declared).
  Section only_if(const std::string &path, const std::vector<std::string> &words) const {
    return with([=](Declared entry) { entry.only_if(path, words); });
  }
  Section only_if(const std::function<bool(const Situation &)> &holds, const std::string &otherwise) const {
    return with([=](Declared entry) { entry.only_if(holds, otherwise); });
  }
  Section unless(const std::string &path, const std::vector<std::string> &words) const {
    return with([=](Declared entry) { entry.unless(path, words); });
  }

  // Throws std::out_of_range for what is not declared.
  Declared at(const std::string &key) { return parameters_.declared(name_ + "/" + key); }
  // Whether one of its entries sets that member of the library's structs.
  bool sets(const std::string &member) const;
  // Whether an entry that is declared already sets a further member from now on; else it is declared once.
  void join(bool further) { join_ = further; }
  const std::string &name() const { return name_; }
  Parameters &parameters() const { return parameters_; }

private:
  Declared declare(const std::string &key, const std::string &default_text, const std::string &unit,
                   const std::string &allowed, const std::string &documentation,
                   std::function<void(const std::string &)> read);

  using Say = std::function<void(Declared)>;
  Section with(Say said) const {
    Section part = *this;
    part.of_each_.push_back(std::move(said));
    return part;
  }

  Parameters &parameters_;
  std::string name_;
  bool join_ = false;
  std::vector<Say> of_each_;
};

// All entries of a scene file, bound to a scene that must stay in place until parameters.release().
void declare_scene(Parameters &parameters, Scene &scene);

} // namespace platen::apps
