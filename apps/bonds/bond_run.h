// What platen-bonds measures: readings along a path, and the figures of a run.
#pragma once

#include <vector>

#include "apps/bonds/pair_section.h"
#include "apps/run/app_output.h"

namespace platen::apps {

// Loads and displacements along the driven coordinate: positive away from the other spheres (tension), along
// the transverse axis in shear. In bending and twisting moment and rotation; force and displacement are 0.
struct BondReading {
  double force = 0, displacement = 0;        // N, m
  double moment = 0, rotation = 0;           // N m, rad
  double normal = 0, shear = 0;              // N, of the tested bond (three: of the left inclined one)
  double tension_ratio = 0, shear_ratio = 0; // stress over strength, largest of all bonds
  double intact = 0;                         // bonds
  double lateral = 0;                        // m, outward displacement of the base spheres (three)
  double strain_ratio = not_given; // lateral over vertical strain (three); NaN where nothing has moved
  // Of a bond with history.
  double tension_damage = 0, shear_damage = 0; // 1
  double plastic_closing = 0;                  // m, that stays when it is unloaded
  double work = 0, stored = 0, dissipated = 0; // J, since the start

  double load() const { return force + moment; }
  double travel() const { return displacement + rotation; }
};

// One pair of bond modulus and stiffness ratio.
struct BondRun : TestFigures {
  // Before anything has moved.
  BondRun(const Scene &scene, const dem::Model &model);
  // At the end.
  void conclude(const dem::Model &model, long steps_made);

  double modulus = 0, stiffness_ratio = 0; // Pa, 1
  double bond_area = 0;                    // m^2
  std::vector<BondReading> rows;           // of the table
  BondReading largest;                     // intact, at the largest load (by magnitude)
  double stiffness = not_given;            // N/m, N m; of the intact bonds
  double break_load = not_given;           // N, N m; the largest that was held before the first break
  double fracture_energy = not_given;      // J/m^2, area under the softening branch of pure tension or shear
  double fracture_work = 0;                // J
};

// bonds.csv.
void write_table(const std::filesystem::path &path, const Scene &scene, const std::vector<BondRun> &runs);
// Some rows of each run, evenly; the table has all.
std::string report(const Scene &scene, const std::vector<BondRun> &runs);
Json summary_of(const Scene &scene, const std::vector<BondRun> &runs, int threads, double seconds);

} // namespace platen::apps
