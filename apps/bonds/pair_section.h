// The section Pair test, which platen-bonds reads. NaN means "not given" where a member says so.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/program.h"
#include "apps/scene/scene.h"

namespace platen::apps {

enum class PairPath { tension, compression, shear, bending, twisting, cyclic, combined };
inline const Words<PairPath> pair_paths{
    {"tension", PairPath::tension},  {"compression", PairPath::compression}, {"shear", PairPath::shear},
    {"bending", PairPath::bending},  {"twisting", PairPath::twisting},       {"cyclic", PairPath::cyclic},
    {"combined", PairPath::combined}};
enum class PairPlate { frictionless, rolling, sticking };
inline const Words<PairPlate> pair_plates{{"frictionless", PairPlate::frictionless},
                                          {"rolling", PairPlate::rolling},
                                          {"sticking", PairPlate::sticking}};

struct PairTest { // platen-bonds
  int particles = 2;
  PairPath path = PairPath::tension;
  PairPlate plate = PairPlate::frictionless; // three particles: what the lower two stand on
  bool base_bond = true;                     // three particles: a bond between the lower two
  double force = not_given;                  // N, largest
  double displacement = not_given;           // m, largest
  // Of bonds with history.
  std::vector<double> turns;  // m, displacements at which the path turns, opening positive; empty: one way
  double pressure = 0;        // Pa, that presses the bond while it is sheared
  double slip_ratio = 1;      // slip over opening of a combined path
  std::vector<double> moduli; // Pa; holds Bond/Modulus where the list is empty
  std::vector<double> stiffness_ratios; // holds Bond/Stiffness ratio where the list is empty
  int steps = 1000;
};

inline const PairTest &pair_test_of(const Scene &scene) {
  return scene.own<PairTest>();
}

inline bool is_pyramid(const Scene &scene) { // three spheres
  return pair_test_of(scene).particles == 3;
}
inline bool turns(const Scene &scene) { // spheres, instead of moving them
  return pair_test_of(scene).path == PairPath::bending || pair_test_of(scene).path == PairPath::twisting;
}
// Whether positions are prescribed, because the bond has a history, not loads.
inline bool is_prescribed(const Scene &scene) {
  return scene.bond.remembers();
}

Program pair_program();

} // namespace platen::apps
