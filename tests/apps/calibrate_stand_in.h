// Closed forms that stand for specimens: what a search is told of them.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "apps/calibrate/search.h"

namespace platen::apps {

inline Target target_of(TargetKind kind, double value, double tolerance = 0.02) {
  const bool elastic = kind == TargetKind::young_modulus || kind == TargetKind::poisson_ratio;
  Target target = elastic ? elastic_target(kind, value) : strength_target(value);
  target.kind = kind, target.tolerance = tolerance;
  return target;
}

inline Target at_pressure(double pressure, double value, double tolerance = 0.02) {
  Target target = strength_target(value, pressure);
  target.tolerance = tolerance;
  return target;
}

// The number of a goal; not a curve. NaN: no peak.
using Numbers = std::function<double(const Goal &goal, const Choice &choice)>;

inline Measurement test_of(const Goals &goals, Numbers numbers) {
  return [&goals, numbers = std::move(numbers)](const std::vector<Choice> &choices, bool elastic_alone) {
    std::vector<Measured> all(choices.size());
    for (std::size_t k = 0; k < choices.size(); ++k) {
      all[k].numbers.resize(goals.all().size()), all[k].curves.resize(goals.all().size());
      for (std::size_t g = 0; g < goals.all().size(); ++g)
        if (goals.all()[g].wanted() && (goals.all()[g].elastic() || !elastic_alone))
          all[k].numbers[g].add(numbers(goals.all()[g], choices[k]));
    }
    return all;
  };
}

} // namespace platen::apps
