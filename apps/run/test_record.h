// A test that is asked for its figures, as far as it has come: what they are computed from.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/run/controls.h"
#include "apps/run/quasi_static.h"
#include "apps/run/results.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/scene.h"
#include "coupling/platen_test.h"
#include "dem/measure/damage.h"
#include "dem/measure/failure_pattern.h"
#include "dem/measure/fragments.h"

namespace platen::apps {

struct RunCosts {
  int threads = 1;
  double wall_seconds = 0, setup_seconds = 0; // s, of all parts of the run; of this part
  long steps_here = 0;                        // steps that this part made
  double step_seconds = 0;                    // s, of those steps
  std::string ended_by;                       // why the run is over; empty: it goes on
};

// Bytes of one bond in its columns and in its block.
std::size_t bytes_per_bond(const dem::Model &model);

// Whether platens press the specimen along its axis until it fails: cones and patterns are reported of no
// other test.
bool measures_pattern(const Scene &scene, const coupling::PlatenTest &problem);

struct TestRecord {
  TestRecord(const Scene &scene, const coupling::PlatenTest &problem, const Results &results,
             const RunCosts &costs);

  const Scene &scene;
  const coupling::PlatenTest &problem;
  const dem::Model &model;
  const Results &results;
  const Emission &emission;
  const RunCosts &costs;
  // Found once for several figures.
  PeakOfCurve peak;
  ModulusState at_modulus;
  Slowness slowness;
  PressurePath path;
  Tiling tiling;
  dem::Fragments fragments;
  std::optional<dem::CrackWidths> widths; // of a test with bonds and a crack log
  std::optional<dem::SplitPattern> split; // of a disc with bonds

  bool is_disc() const { return problem.shape().kind == dem::ShapeKind::disc; }
  bool is_tension() const; // of the bonds: a specimen that is pulled, bent or split
  bool is_staged() const { return !problem.settings().loading.stages.empty(); }
  bool is_on_path() const { return problem.cell() && problem.settings().loading.cell->path != 0; }
  bool is_loaded() const { return results.largest_deviator().value > 0; }
  bool presses(coupling::Side side, int but_axis) const; // a platen there, along another axis
  bool presses_sides() const;                            // besides top and bottom
  std::size_t bonds() const { return model.bonds ? model.bonds->initial_count() : 0; }
  std::size_t bytes_per_bond() const { return apps::bytes_per_bond(model); }
  double particle_steps_per_second() const;
  std::uint64_t peak_memory_bytes() const;
  Json stage_seconds() const;

  bool is_slowness_known() const;
  std::vector<std::string> signs_of_haste() const; // none where that is not known

  // Of a bent bar. Poisson's ratio is of the share of shear in a deflection, which the bar does not show:
  // between 0.1 and 0.3 the share changes by a sixth.
  static constexpr double assumed_poisson_ratio = 0.2;
  double flexural_modulus() const;     // Pa
  double moment_over_nominal() const;  // moment at mid-span over P L / 4
  double oscillations_to_peak() const; // how often it could have swung until the peak
  double cracks_near_midspan() const;
  // Of a notched one: work of the platens on their way, without that of its weight; load at the end over that
  // at the peak.
  double work_of_fracture() const; // J
  double load_at_end_over_peak() const { return results.stress_at_end() / results.strength(); }

  // Of the state at 0.8 of the peak, or of the last one.
  const dem::FailureMeasures &failure(bool last) const;
  const dem::DeadZone &dead_zone(bool last, dem::End end) const {
    return failure(last).dead[static_cast<std::size_t>(end)];
  }
  bool has_failure(bool last) const { return !std::isnan(failure(last).broken_fraction); }
  bool has_pattern(bool last) const { return measures_pattern(scene, problem) && has_failure(last); }
  bool has_emission() const;
  std::string word_of_pattern(bool last) const;
  std::vector<std::string> reasons_of_pattern(
      bool last) const; // what decided, and each cone or why it is none
};

// "r0 0.97, 24.1 mm high, half-angle 44 degrees, 0.13 of the volume, confidence 0.58", or why there is none;
// the measure that decided the pattern.
std::string cone_words(const dem::DeadZone &zone);
std::string reason_words(const dem::FailureMeasures &measures);

} // namespace platen::apps
