// The testing machine of platen-bonds: two or three bonded spheres, fixed but for what a test frees and
// driven along one coordinate, brought to rest at every load by the explicit scheme with local damping.
#pragma once

#include <array>
#include <vector>

#include "apps/bonds/closed_forms.h"
#include "apps/scene/scene.h"
#include "dem/model.h"

namespace platen::apps {

// What is read off at rest. Loads and displacements along the driven coordinate: positive away from the other
// spheres (tension), along the transverse axis in shear; moment and rotation in bending and twisting.
struct RigReading {
  double force = 0, displacement = 0;        // N, m
  double moment = 0, rotation = 0;           // N m, rad
  double normal = 0, shear = 0;              // N, of the tested bond (three: of the left inclined one)
  double tension_ratio = 0, shear_ratio = 0; // stress over strength, largest of all bonds
  int intact = 0;
  double lateral = 0;      // m, outward path of the base spheres (three)
  double strain_ratio = 0; // lateral over vertical strain (three); NaN where nothing has moved

  double utilisation() const { return tension_ratio > shear_ratio ? tension_ratio : shear_ratio; }
};

bool is_pyramid(const Scene &scene); // three spheres
// Sphere 0 is driven. Two: sphere 1 below it. Three: on spheres 1 and 2 that lie on the plate.
dem::Specimen touching_spheres(const Scene &scene);
// The scene's, for one pair of bond modulus (Pa) and stiffness ratio.
dem::ModelSettings rig_settings(const Scene &scene, double modulus, double stiffness_ratio);

class BondRig {
public:
  // Throws InputError where the time step that the scene sets is above the limit.
  BondRig(const Scene &scene, double modulus, double stiffness_ratio);

  // Loads (N; N m for bending and twisting) or moves (m; rad) the driven coordinate to this value and waits
  // until all is at rest: no free coordinate out of balance by more than 1e-8 of the largest load so far. A
  // load cannot be held once the bond that takes it has broken: loading then ends where the break is noticed.
  // Throws NumericsError if it does not come to rest.
  RigReading load_to(double load);
  RigReading move_to(double displacement);

  const BondSection &section() const { return section_; }
  dem::Model &model() { return model_; }
  double time_step() const { return dt_; }
  const std::string &time_step_reason() const { return reason_; }
  long steps() const { return steps_; }
  int bonds_at_start() const { return bonds_at_start_; }

private:
  // Coordinate of a sphere: 0, 1, 2 displacement along x, y, z; 3, 4, 5 rotation about them.
  double &speed(std::size_t sphere, std::size_t coordinate);
  double &load(std::size_t sphere, std::size_t coordinate);
  void prescribe_coordinates();
  void step();
  RigReading settle();
  RigReading read() const;
  double imbalance() const;
  void take_loads();
  double driven_load() const;
  double driven_displacement() const;
  void roll();
  void check_time_step();

  const Scene &scene_;
  BondSection section_;
  std::size_t coordinates_; // of a sphere; three without rotation
  bool rolls_;              // the base spheres, on the plate
  dem::Model model_;
  std::vector<std::size_t> row_;             // of sphere 0 (driven), 1 and 2
  std::vector<std::array<double, 6>> loads_; // of the same, by bonds and contacts, in the last step
  std::vector<std::array<bool, 6>> fixed_;
  std::size_t driven_ = 2; // coordinate of sphere 0
  double applied_ = 0, drive_speed_ = 0, scale_ = 0;
  bool by_load_ = true;
  double dt_ = 0;
  std::string reason_;
  long steps_ = 0;
  int bonds_at_start_ = 0;
  std::size_t touching_ = 0;
};

} // namespace platen::apps
