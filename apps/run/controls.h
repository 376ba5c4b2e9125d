// What the stages of a test asked of its sides, what was reached, and what follows for its figures.
#pragma once

#include <string>
#include <vector>

#include "apps/run/results.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Of the lateral surface that a cell's pressure loads: with less a test is no longer one at its pressure.
constexpr double least_confined = 0.9;

// Of a stage that is over: "stage 1 (ended by: time) has not reached what it asked: top stress 3.42 of 5
// MPa"; empty where all was met.
std::string words_of_misses(const coupling::PlatenTest &problem, std::size_t stage);
// Whether the specimen had its peak in that stage: after it, it need not bear what is asked.
bool failed_in(const coupling::PlatenTest &problem, const Results &results, std::size_t stage);
// How many stages are over: with the test its last one is.
std::size_t stages_over(const coupling::PlatenTest &problem, bool test_ended);
// "target", or "target; not reached: top stress of stage 1", of so many stages from the first, where the
// specimen did not fail in them.
std::string with_misses(const std::string &ended_by, const coupling::PlatenTest &problem,
                        const Results &results, std::size_t stages);

// What speaks against a figure that is read off at a time (s): stresses and pressures that were asked, and
// not reached, until then, unless something else has been asked along the same axis since. A rate that was
// not reached does not: figures are reported with the strains and speeds that were reached.
std::vector<std::string> controls_against(const coupling::PlatenTest &problem, const Results &results,
                                          double time);
// And that a cell's pressure no longer loaded enough of the lateral surface; empty where it did, or where
// that is not known (no cell, no pressure on a sleeve).
std::string confinement_against(const Results &results, double time);

constexpr double most_off_path = 0.01; // of the pressure

// Of a test whose pressure gains a share of the deviator, up to the peak or to where the path ends.
struct PressurePath {
  // Largest distance from the path, over its pressure there or that which it begins with, the larger; NaN
  // without a path.
  double deviation = not_measured;
  double ended_at_strain =
      not_measured; // of the platens since consolidation, where the pressure came to nothing
};
PressurePath pressure_path(const coupling::PlatenTest &problem, const Results &results);

} // namespace platen::apps
