// What a search may change, as the coordinates that it moves in (choice.h): logarithms, but of what may be
// zero, which is taken as it is; of the shear strength that over the tensile one, so that strengths grow in
// proportion along one coordinate.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "apps/calibrate/choice.h"
#include "apps/calibrate/goals.h"
#include "apps/calibrate/response_model.h"

namespace platen::apps {

// What Calibrate/Free and Parameter 1, ... name, else what the targets need; those whose bounds leave them no
// room are left out.
std::vector<ParameterFacts> parameters_of(const Scene &scene);

class Space {
public:
  // About a choice, which is held where it is not free.
  Space(const Scene &scene, const Choice &start, const std::vector<ParameterFacts> &free);

  std::vector<ParameterFacts> free() const;
  bool free(FreeParameter parameter) const { return place(parameter) < count(); }
  Choice choice(const Eigen::VectorXd &x) const;
  // With a free number whose coordinate is its logarithm times a factor.
  Eigen::VectorXd scaled(Eigen::VectorXd x, FreeParameter parameter, double factor) const;
  // With the start, bounds, steps, and whether strengths grow in proportion to the bonds' whatever the trials
  // say (`exact`).
  std::vector<SearchParameter> parameters(bool exact) const;
  // What slopes begin with, by rows of responses: Voigt's formulas, and what was seen of one concrete.
  Eigen::MatrixXd guess(const Goals &goals, const std::vector<std::size_t> &of) const;
  // Slopes by the coordinates as slopes by the logarithms of the parameters themselves at a choice; of a
  // number that may be zero, and is less than a tenth of its room, by that tenth.
  Eigen::MatrixXd by_logarithms(const Eigen::MatrixXd &slopes, const Choice &at) const;
  // "stiffness ratio 0.02 (searched from 0.02 to 1)": those of a choice that are at their bounds.
  std::vector<std::string> at_bounds(const Choice &at) const;

private:
  struct Axis {
    ParameterFacts facts;
    Bounds bounds; // of the number itself

    double number(const Choice &of) const; // that the axis is of
    double place_of(double number) const;  // its coordinate
    double number_at(double coordinate) const;
    double room() const { return bounds.high - bounds.low; }
  };
  Eigen::Index place(FreeParameter parameter) const; // count() of one that is not free
  Eigen::Index count() const { return static_cast<Eigen::Index>(axes_.size()); }

  Choice start_;
  std::vector<Axis> axes_;
};

} // namespace platen::apps
