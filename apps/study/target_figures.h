// What the runs of a study of a target have given so far: figures by scene, packing and speed, and their
// costs.
#pragma once

#include <cmath>
#include <vector>

#include "apps/many/runs.h"
#include "apps/study/study_section.h"
#include "apps/study/target_plan.h"

namespace platen::apps {

// The speeds that a target chooses from.
std::vector<double> target_transits(const Scene &scene);

// Places of the cases of a target in its plan.
struct TargetCases {
  std::size_t speeds = 0, scenes = 1;
  bool half_step = false, coarser = false;
  std::size_t at(std::size_t scene, std::size_t speed) const { return scene * speeds + speed; }
  std::size_t of_half_step(std::size_t scene) const { return scenes * speeds + scene; }
  std::size_t of_coarser(std::size_t scene) const { return scenes * (speeds + (half_step ? 1 : 0)) + scene; }
};
TargetCases target_cases(const Scene &scene);

// By what runs of so many spheres are expected to differ before there are any.
SpreadPrior expected_spread(TargetFigure figure, double spheres);
// b of 1.5, above all that docs/accuracy.md measured.
RunErrors expected_errors(TargetFigure figure, double spheres);

// A difference of logarithms between packings run twice, or between two sets of packings.
struct MeasuredChange {
  double mean = 0, error = 0; // standard error of the mean
  double freedom = 0;
  double half(double confidence) const; // of its interval
  bool is_certain(double confidence) const { return std::abs(mean) > half(confidence); }
};

class TargetFigures {
public:
  explicit TargetFigures(const Scene &scene);

  // Of case `run.of` on the packing of that number, from 0 on. A run that failed or never peaked has none.
  void add(const TestRun &run, std::size_t packing, const RunOutcome &outcome);

  // Logarithms of the figure; of a gain differences of both scenes.
  TargetRuns runs() const;
  // The largest square of b that the scenes of a gain have by themselves.
  double curvature_of_scenes() const;

  // In steps times spheres, of all scenes. Those of a speed without runs follow from the others; before there
  // are any, as many steps as study_target_cylinder takes.
  TargetCosts costs() const;
  LinearCost linear_cost() const;
  double work() const { return work_; }       // done, packings included
  double seconds() const { return seconds_; } // of one core
  std::size_t made() const { return made_; }
  double spheres() const; // of a run; counted in the shape where there is none yet
  std::size_t without_figure() const { return without_; }

  std::optional<MeasuredChange> of_half_step() const, of_coarser() const;

private:
  struct Work {
    double sum = 0, runs = 0;
  };
  // By packing: of a case and, of a gain, over the case of the other scene, `stride` further on.
  std::vector<double> figures_of(std::size_t of_first_scene, std::size_t stride) const;
  template <class Figures> // of a speed, by packing
  TargetRuns runs_of(const Figures &of) const;

  TargetFigure figure_;
  TargetCases cases_;
  std::vector<double> transits_;
  std::vector<std::vector<double>> logs_; // by case and packing
  std::vector<Work> works_;               // by case
  std::vector<bool> was_packed_;          // by packing
  double counted_spheres_ = 0;
  double spheres_ = 0, work_ = 0, seconds_ = 0; // spheres: sum over runs at the scene's size
  std::size_t made_ = 0, without_ = 0, with_spheres_ = 0;
};

} // namespace platen::apps
