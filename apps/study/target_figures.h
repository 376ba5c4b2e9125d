// What the runs of a study of a target have given so far: figures by scene, packing and speed, and their
// costs.
#pragma once

#include <array>
#include <vector>

#include "apps/many/runs.h"
#include "apps/study/cases.h"
#include "apps/study/study_section.h"
#include "apps/study/target_plan.h"

namespace platen::apps {

// A difference of logarithms between packings run twice, or between two sets of packings.
struct MeasuredChange {
  double mean = 0, error = 0; // standard error of the mean
  double freedom = 0;
  bool is_certain(double confidence) const; // whether the interval leaves 0 out
  double half(double confidence) const;
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
  using Logs = std::vector<std::vector<double>>; // by packing and case
  struct Work {
    double sum = 0, runs = 0;
  };
  double figure_of(std::size_t packing, std::size_t of_first_scene, std::size_t stride) const;
  std::vector<double> figures_of(std::size_t of_first_scene, std::size_t stride) const;

  TargetFigure figure_;
  TargetCases cases_;
  std::vector<double> transits_;
  Logs logs_;
  std::vector<Work> works_;      // by case
  std::vector<bool> was_packed_; // by packing
  double counted_spheres_ = 0;
  double spheres_ = 0, work_ = 0, seconds_ = 0; // spheres: sum over runs at the scene's size
  std::size_t made_ = 0, without_ = 0, with_spheres_ = 0;
};

// Slope and height of the straight line through points, by least squares; through the origin of one.
LinearCost line_through(const std::vector<double> &transits, const std::vector<double> &costs);

} // namespace platen::apps
