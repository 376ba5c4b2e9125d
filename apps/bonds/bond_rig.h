// The testing machine of platen-bonds: two or three bonded spheres, fixed but for what a test frees and
// driven along one coordinate, brought to rest at every load by the explicit scheme with local damping.
#pragma once

#include <array>
#include <vector>

#include "apps/bonds/bond_run.h"
#include "apps/scene/scene.h"
#include "dem/model.h"

namespace platen::apps {

// Sphere 0 is driven. Two: sphere 1 below it. Three: on spheres 1 and 2 that lie on the plate.
dem::Specimen touching_spheres(const Scene &scene);
// The scene's, of spheres that touch.
dem::ModelSettings pair_settings(const Scene &scene);

class BondRig {
public:
  // Throws InputError where the time step that the scene sets is above the limit.
  explicit BondRig(const Scene &scene);

  // Loads (N; N m for bending and twisting) or moves (m; rad) the driven coordinate to this value and waits
  // until all is at rest: no free coordinate out of balance by more than 1e-8 of the largest load so far. A
  // load cannot be held once the bond that takes it has broken: loading then ends where the break is noticed.
  // Throws NumericsError if it does not come to rest.
  BondReading load_to(double load);
  BondReading move_to(double displacement);

  const dem::Model &model() const { return model_; }
  double time_step() const { return dt_; }
  const std::string &time_step_reason() const { return reason_; }
  long steps() const { return steps_; }

private:
  // Coordinate of a sphere: 0, 1, 2 displacement along x, y, z; 3, 4, 5 rotation about them.
  double &speed(std::size_t sphere, std::size_t coordinate);
  double &load(std::size_t sphere, std::size_t coordinate);
  void prescribe_coordinates();
  void step();
  BondReading settle();
  BondReading read() const;
  double imbalance() const;
  double driven_load() const;
  double driven_displacement() const;
  void roll();
  void check_time_step();

  const Scene &scene_;
  std::size_t coordinates_; // of a sphere; three without rotation
  bool rolls_;              // the base spheres, on the plate
  dem::Model model_;
  const double radius_, axial_stiffness_;    // m, N/m; of a sphere, of an intact bond
  std::vector<std::size_t> row_;             // of sphere 0 (driven), 1 and 2
  std::vector<std::array<double, 6>> loads_; // of the same, by bonds and contacts, in the last step
  std::vector<std::array<bool, 6>> fixed_;
  std::size_t driven_ = 2; // coordinate of sphere 0
  double applied_ = 0, drive_speed_ = 0, scale_ = 0;
  bool by_load_ = true;
  double dt_ = 0;
  std::string reason_;
  long steps_ = 0;
  std::size_t touching_ = 0;
};

} // namespace platen::apps
