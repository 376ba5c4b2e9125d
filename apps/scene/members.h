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

// Declares the one member of that name.
class MemberVisitor {
public:
  MemberVisitor(Section &section, std::string owner, const std::string &member, const std::string &key)
      : section_(section), owner_(std::move(owner)), member_(member), key_(key) {}

  void operator()(const char *name, double &to, const char *unit, const Range &range, const char *sentence) {
    if (name == member_) keep(section_.quantity(key_, to, unit, range, sentence));
  }
  void operator()(const char *name, std::vector<double> &to, const char *unit, const Range &range,
                  const char *sentence) {
    if (name == member_) keep(section_.list(key_, to, unit, range, sentence));
  }
  template <class Enum>
  void operator()(const char *name, Enum &to, const Words<Enum> &words, const char *sentence) {
    if (name == member_) keep(section_.word(key_, to, words, {}, sentence));
  }
  void operator()(const char *name, bool &to, const char *sentence) {
    if (name == member_) keep(section_.flag(key_, to, sentence));
  }
  void operator()(const char *name, Gap &to, const char *sentence) {
    if (name == member_) keep(section_.gap(key_, to, sentence));
  }
  void operator()(const char *name, Stiffness &to, const char *sentence) {
    if (name == member_) keep(section_.stiffness(key_, to, true, sentence));
  }

private:
  void keep(Declared declared) { declared.member(owner_, member_); }

  Section &section_;
  std::string owner_;
  const std::string &member_, &key_;
};

template <class Described>
class Members {
public:
  Members(Section &section, Described &of) : section_(section), of_(of) {}
  // The member of this name; its key is as said, or follows from the name. Throws std::out_of_range where no
  // member has it.
  Declared operator()(const std::string &member, const std::string &key = "") {
    const std::string under = key.empty() ? key_of(member) : key;
    Described::describe(MemberVisitor(section_, Described::name, member, under), of_);
    return section_.at(under);
  }

private:
  Section &section_;
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

// A list of the names of what is described.
struct Names {
  std::vector<std::string> all, flags;
  template <class Member, class... Rest>
  void operator()(const char *name, const Member &, const Rest &...) {
    (std::is_same_v<Member, bool> ? flags : all).emplace_back(name);
  }
};

// Entries made of the parameters of all bond laws: one of a name sets it in each law that has it, and has an
// effect with these alone.
class LawMembers {
public:
  LawMembers(Section &section, dem::BondLaws::AllParameters &laws) : section_(section), laws_(laws) {}
  Declared operator()(const std::string &member);
  // All that have not been declared, but for flags: these are effects.
  void rest();

private:
  Section &section_;
  dem::BondLaws::AllParameters &laws_;
};

} // namespace platen::apps
