// The law that holds the grains together, and what every law is given: an entry of section Bond sets the
// member of its name in all laws that have it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem/heterogeneity.h"
#include "dem/laws/bond_law.h"

namespace platen::apps {

class Bond {
public:
  static constexpr int none = -1;
  int law = 0; // Effects/Bond: the place in dem::BondLaws, or none
  dem::BondLaws::AllParameters laws;
  bool scattered = false; // Strength scatter
  dem::StrengthScatter scatter;

  bool bonded() const { return law != none; }
  template <class Law>
  bool is() const {
    return law == static_cast<int>(dem::BondLaws::place<Law>());
  }
  const char *word() const { return bonded() ? dem::BondLaws::words[static_cast<std::size_t>(law)] : "none"; }
  std::optional<dem::BondParameters> parameters() const;
  bool remembers() const;
  bool bonds_by_range() const;
  bool has(const std::string &member) const; // the law chosen
  // By the name of a member: of the first law that has it; in all of them.
  double number(const std::string &member) const;
  void set(const std::string &member, double value);
  // Of the law chosen, empty where it has none; in all that have it.
  std::vector<double> list(const std::string &member) const;
  void set(const std::string &member, const std::vector<double> &values);
};

} // namespace platen::apps
