// A pressure on the lateral skin of the specimen, as a cell's oil has it through a thin sleeve that carries
// nothing itself: -p a on each sphere of the skin, a its outward area vector, at its centre.
//
// Only pieces that hold together by intact bonds and have at least a twentieth of the spheres are pressed:
// what has come loose is left alone, and the pressure goes to what lies bare beneath. What of the lateral
// surface is then still loaded is told, and the pressure that is told is the one that acts over all of it.
// Areas are found anew
// where spheres have moved by a twentieth of the mean radius or bonds have broken since; in between, area
// vectors stand still (a dead load), so that the work is exact.
#pragma once

#include <vector>

#include "base/archive.h"
#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/skin.h"

namespace platen::dem {

enum class ConfinementArea {
  voronoi, // of the sphere's own part of the deformed surface (dem/skin.h), times one factor for all
  // pi R^2 of each sphere that lay within a mean radius of the lateral surface, radially (Onate et al. 2015);
  // their sum is not the area of the specimen
  sphere
};

class Confinement {
public:
  // Takes the particles as they are for the intact specimen. Voronoi areas are multiplied by one factor, kept
  // from here on, that gives them the nominal lateral area of the shape between the planes. `bonds` may be
  // null: all spheres are of one piece then.
  Confinement(const Particles &particles, const Bonds *bonds, const Shape &shape, const EndPlanes &planes,
              ConfinementArea kind);

  // Once a step, after the drift of dt (s), before bonds are computed: `distance` (m) bounds what any
  // particle moved. `due`: areas may be found anew in this step, from bonds that were broken before it.
  void update(const Particles &particles, const Bonds *bonds, const EndPlanes &planes, double dt,
              double distance, bool due);
  // Then presses with `pressure` (Pa) and adds its work over dt (s).
  void add_forces(Particles &particles, double pressure, double dt);

  // Pa, that acts now: the sum of the forces over the lateral area. The pressure that was given while the
  // specimen is whole.
  double pressure() const { return loaded_share_ * pressure_; }
  // 1, of the lateral area between the planes: what is pressed now over what was pressed when the specimen
  // was last whole, at most 1. It is 1 until the first sphere has come loose.
  double loaded_share() const { return loaded_share_; }
  double work() const { return work_; }     // J, done by the pressure since the start
  double factor() const { return factor_; } // of Voronoi areas
  // Sum of the area vectors along the outward normals of the shape over its lateral area: 1 where the whole
  // surface is pressed once.
  double coverage(const Particles &particles, const EndPlanes &planes) const;
  std::size_t size() const { return particle_.size(); }
  // Rows that it presses, ascending, and how often they were found.
  std::vector<int> particles() const { return {particle_.begin(), particle_.end()}; }
  long lists_made() const { return lists_made_; }
  int particle(std::size_t k) const { return particle_[k]; }
  const Vector3 &area(std::size_t k) const { return area_[k]; } // m^2, outward

  void describe(Archive &archive);

private:
  void find(const Particles &particles, const Bonds *bonds, const EndPlanes &planes);
  Skin sphere_skin(const Particles &particles, const std::vector<char> &body) const;
  Vector3 outward(const Vector3 &area, const Vector3 &position) const;
  double power(const Particles &particles) const;

  Shape shape_;
  ConfinementArea kind_;
  double mean_radius_ = 0, factor_ = 1;
  double pressure_ = 0, work_ = 0; // Pa, as it was given; J
  std::size_t whole_ = 0;          // spheres of pieces that are pressed, at the start
  double whole_coverage_ = 1, loaded_share_ = 1;
  long lists_made_ = 0;
  double moved_ = 0, broken_ = 0; // m and bonds, when and since the areas were found
  Table table_;
  Column<int> &particle_ = table_.add<int>("particle", "1");
  Column<Vector3> &area_ = table_.add<Vector3>("area", "m2");
};

} // namespace platen::dem
