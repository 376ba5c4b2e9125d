// summary.json of a test between platens.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/run/results.h"
#include "apps/scene/scene.h"
#include "coupling/platen_test.h"

namespace platen::apps {

struct RunCosts {
  int threads = 1;
  double wall_seconds = 0, setup_seconds = 0; // s, of all parts of the run; of this part
  long steps_here = 0;                        // steps that this part made
  double step_seconds = 0;                    // s, of those steps
  std::string ended_by;                       // why the run is over; empty: it goes on
};

// status: "done", "stopped" or "failed". Numbers that were not measured are NaN, written null.
nlohmann::ordered_json summary_of_run(const std::string &status, const Scene &scene,
                                      const coupling::PlatenTest &problem, const Results &results,
                                      const RunCosts &costs);

// "platen-compress" or "platen-brazilian".
const char *app_of(const coupling::PlatenTest &problem);

// The sides with platens besides those of an axis: top and bottom.
std::vector<coupling::Side> further_sides(const coupling::PlatenTest &problem, int axis = 2);

// Bytes of one bond in its columns and in its block.
std::size_t bytes_per_bond(const dem::Model &model);
// A few lines for the screen: strength, strains, moduli, damage, energy.
std::string report_of_run(const Scene &scene, const coupling::PlatenTest &problem, const Results &results,
                          const RunCosts &costs);

} // namespace platen::apps
