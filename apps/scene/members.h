// Entries made of the members of structs that describe themselves (base/describe.h): unit, range, words,
// meaning and default stand there alone.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "apps/scene/declare.h"
#include "dem/laws/bond_law.h"

namespace platen::apps {

// "stiffness_ratio" is the key "Stiffness ratio".
std::string key_of(const std::string &member);

// Declares the member of that name, if there is one.
template <class Described>
void declare_member(Section &section, Described &of, const std::string &member, const std::string &key) {
  Described::describe(
      [&](const char *name, auto &to, const auto &...about) {
        if (name == member)
          section.entry(key, to, about...).member(std::string(Described::name) + "." + member);
      },
      of);
}

template <class Described>
class Members {
public:
  Members(const Section &section, Described &of) : section_(section), of_(of) {}
  // The member of this name; its key is as said, or follows from the name. Throws std::out_of_range where no
  // member has it.
  Declared operator()(const std::string &member, const std::string &key = "") {
    const std::string under = key.empty() ? key_of(member) : key;
    declare_member(section_, of_, member, under);
    return section_.at(under);
  }
  // All members that the section does not have, but for those that another one has, under the keys that
  // follow from their names.
  void rest(const std::vector<std::string> &elsewhere = {}) {
    std::vector<std::string> all;
    Described::describe([&](const char *name, const auto &...) { all.emplace_back(name); }, of_);
    for (const std::string &member : all)
      if (std::find(elsewhere.begin(), elsewhere.end(), member) == elsewhere.end() &&
          !section_.sets(std::string(Described::name) + "." + member))
        (*this)(member);
  }

private:
  Section section_;
  Described &of_;
};

// What a number, or each of a list, may be. Throws std::logic_error where no member has that name.
template <class Described>
Range range_of(const std::string &member) {
  const Range *found = nullptr;
  Range range;
  const Described of;
  Described::describe(
      [&](const char *name, const auto & /*value*/, const auto &...about) {
        if constexpr (sizeof...(about) == 3) // unit, range, sentence
          if (name == member) range = std::get<1>(std::tie(about...)), found = &range;
      },
      of);
  if (found == nullptr) throw std::logic_error(std::string(Described::name) + " has no number " + member);
  return range;
}

// The words that a member may be. Throws std::logic_error where none of that name has words.
template <class Described, class Enum>
Words<Enum> words_of(const std::string &member) {
  Words<Enum> words;
  Described of;
  Described::describe(
      [&](const char *name, const auto & /*value*/, const auto &...about) {
        if constexpr (std::is_same_v<std::decay_t<std::tuple_element_t<0, std::tuple<decltype(about)...>>>,
                                     Words<Enum>>)
          if (name == member) words = std::get<0>(std::tie(about...));
      },
      of);
  if (words.empty()) throw std::logic_error(std::string(Described::name) + " has no word " + member);
  return words;
}

// Entries made of the parameters of all bond laws: one of a name sets it in each law that has it, and has an
// effect with these alone.
class LawMembers {
public:
  LawMembers(const Section &section, dem::BondLaws::AllParameters &laws) : section_(section), laws_(laws) {}
  Declared operator()(const std::string &member);
  // All that have not been declared, but for flags: these are effects.
  void rest();

private:
  Section section_;
  dem::BondLaws::AllParameters &laws_;
};

} // namespace platen::apps
