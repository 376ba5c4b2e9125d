// Closed forms that stand for specimens: what a search is told of them.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/calibrate/analysis.h"
#include "base/pi.h"

namespace platen::apps {

using Texts = std::vector<std::string>;
constexpr const char *const in_a_cell = "Loading/Confinement = particles, Loading/Confining pressure = ";

// As "Target 1" ... have them, with one tolerance.
inline std::vector<Target> targets_of(const Texts &lines, double tolerance) {
  std::vector<Target> targets;
  for (const std::string &line : lines) {
    targets.push_back(read_target(line));
    targets.back().tolerance = tolerance;
  }
  return targets;
}

// Of bonds that yield, to be changed in these parameters, whose effects are measured before the search.
inline Scene yielding_scene(std::vector<Target> targets = {}, std::vector<FreeParameter> free = {}) {
  Scene s;
  s.bond.law = static_cast<int>(dem::BondLaws::place<dem::YieldingParallelBond>());
  s.bond.set("compression_limits", std::vector<double>{60e6, 110e6, 160e6});
  s.bond.set("compression_slopes", std::vector<double>{3, 12, 22});
  s.model.bond_layout.modulus = 30e9;
  s.bond.set("stiffness_ratio", 0.5);
  s.bond.set("tensile_strength", 6e6);
  s.bond.set("shear_strength", 15e6);
  s.bond.set("friction_angle", 35 * degree);
  s.bond.set("moment_contribution", 0.5);
  s.contact.friction = 0.5;
  Calibrate &c = s.own<Calibrate>();
  c.most_trials = 60, c.tolerance = 0.02;
  c.targets = std::move(targets), c.free = std::move(free);
  c.differences = true;
  return s;
}

// The numbers of a goal on the packings; not of a curve. NaN: no peak.
using Numbers = std::function<std::vector<double>(const Goal &goal, const Choice &choice)>;

inline Measurement measured_on_packings(const Goals &goals, Numbers numbers) {
  return [&goals, numbers = std::move(numbers)](const std::vector<Choice> &choices, bool elastic_alone) {
    std::vector<Measured> all(choices.size(), Measured(goals.all().size()));
    for (std::size_t k = 0; k < choices.size(); ++k)
      for (const std::size_t g : goals.wanted(elastic_alone))
        for (const double number : numbers(goals.all()[g], choices[k]))
          all[k].numbers[g].add(number);
    return all;
  };
}

// On one packing.
inline Measurement test_of(const Goals &goals, std::function<double(const Goal &, const Choice &)> number) {
  return measured_on_packings(goals, [number = std::move(number)](const Goal &goal, const Choice &choice) {
    return std::vector<double>{number(goal, choice)};
  });
}

} // namespace platen::apps
