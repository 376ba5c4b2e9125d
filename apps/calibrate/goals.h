// What is wanted of a specimen, the tests that tell it, and how far what was measured lies from it.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "apps/calibrate/trials.h"
#include "apps/output/seed_statistics.h"

namespace platen::apps {

struct Goal : Target {             // without a value: only watched
  std::size_t test = 0, other = 0; // places of its tests; the figure of the other one divides
  std::optional<Curve> curve;

  bool wanted() const { return given(value) || curve; }
  bool has_logarithm() const { // others may be negative, or zero
    return kind != TargetKind::poisson_ratio && kind != TargetKind::secant_ratio && kind != TargetKind::other;
  }
  Eigen::Index rows() const { return curve ? curve_points : 1; } // of the responses
};

// Over the packings, by goal. Of a curve: root mean squares of its misses, and the mean stresses (Pa).
struct Measured {
  explicit Measured(std::size_t goals = 0) : numbers(goals), curves(goals) {}
  std::vector<SeedStatistics> numbers;
  std::vector<std::vector<double>> curves;
  SeedStatistics platen_modulus; // Pa
  int failed = 0;                // runs
  std::string too_fast;          // why the first of them that was not quasi-static does not count
};

// What the mean over more packings is, over that of the packings that a search runs on: by goal a factor; of
// a curve what is added to its points (Pa). Empty: nothing.
struct Correction {
  std::vector<double> factors;
  std::vector<std::vector<double>> added;
};
Measured corrected(Measured measured, const Correction &by);

class Goals {
public:
  // Those of the scene, then Young's modulus and Poisson's ratio where they are not among them, to be
  // watched. Throws InputError for a curve that is none.
  explicit Goals(const Scene &scene);

  const Calibrate &asked() const { return asked_; }
  const std::vector<Goal> &all() const { return goals_; }
  const std::vector<SpecimenTest> &tests() const { return tests_; } // the longest first, elastic last
  std::size_t elastic_test() const { return tests_.size() - 1; }
  // The places of those that are wanted, or of those of them that static solves tell.
  std::vector<std::size_t> wanted(bool elastic_alone = false) const;

  // `results`: of one packing after the other, all tests of each (or the elastic one alone).
  Measured measured(const std::vector<TrialResult> &results, bool elastic_alone = false) const;

  // Relative, signed; of a curve the root mean square; NaN where it was not measured.
  double miss(std::size_t goal, const Measured &measured) const;
  bool met(std::size_t goal, const Measured &measured) const;
  // Met with a margin of two standard errors of the mean over the packings, so that others meet it too; a
  // quarter of the tolerance is enough where the packings scatter more than it.
  bool surely_met(std::size_t goal, const Measured &measured) const;
  // Of the mean over `training` and further packings, each measured at the choice of the training beside it.
  Correction correction(const std::vector<Measured> &training, const std::vector<Measured> &further) const;
  // What a search makes small, the rows of each goal after each other: logarithms of measured over wanted
  // numbers (of what may be negative or zero, as Poisson's ratio, the relative difference), differences of a
  // curve's points; in multiples of the goal's tolerance over Calibrate/Tolerance. A specimen that comes to
  // no peak counts as twice too strong where pressure or friction hold it; empty where another one comes to
  // none.
  Eigen::VectorXd responses(const std::vector<std::size_t> &goals, const Measured &measured) const;
  double scale(std::size_t goal) const; // of its responses

private:
  void add(const Target &target);
  std::size_t place_of(const Goal &goal, const std::vector<std::string> &entries, const std::string &name);

  const Calibrate &asked_;
  std::vector<Goal> goals_;
  std::vector<SpecimenTest> tests_;
};

} // namespace platen::apps
