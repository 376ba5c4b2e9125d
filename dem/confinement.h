// Pressure on the lateral skin of the specimen, as from the oil of a cell through a thin sleeve that carries
// no load: the force -p a on each sphere of the skin, a its outward area vector, at its centre.
//
// Only pieces that are connected by intact bonds and have at least a twentieth of the spheres are loaded:
// loose spheres are not, and the pressure acts on the spheres exposed below. The loaded fraction of the
// lateral surface is reported, and the reported pressure is the mean over all of it. Areas are computed again
// when spheres have moved by a twentieth of the mean radius or bonds have broken; in between, area vectors
// are constant (a dead load), so that the work is exact.
#pragma once

#include <vector>

#include "base/archive.h"
#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/skin.h"

namespace platen::dem {

enum class ConfinementArea {
  voronoi, // of the sphere's part of the deformed surface (dem/skin.h), times one factor for all
  // pi R^2, outwards, of each sphere that initially lay within a mean radius of the lateral surface (Onate et
  // al. 2015); the sum is not the area of the specimen
  sphere
};

class Confinement {
public:
  // The present particles are the intact specimen. Voronoi areas are multiplied by one constant factor that
  // gives them the nominal lateral area of the shape between the planes. `bonds` may be null: then all
  // spheres are one piece.
  Confinement(const Particles &particles, const Bonds *bonds, const Shape &shape, const EndPlanes &planes,
              ConfinementArea kind);

  // To call once a step, after the drift of dt (s), before bonds are computed: no particle has moved by more
  // than `distance` (m). `due`: areas may be computed again in this step, from bonds broken before it.
  void update(const Particles &particles, const Bonds *bonds, const EndPlanes &planes, double dt,
              double distance, bool due);
  // To call after update(): applies `pressure` (Pa) and adds its work over dt (s).
  void add_forces(Particles &particles, double pressure, double dt);

  // Pa, acting now: the sum of the forces over the lateral area. Equal to the given pressure while the
  // specimen is intact.
  double pressure() const { return loaded_fraction_ * pressure_; }
  // 1, fraction of the lateral area between the planes: the area loaded now over the area loaded when the
  // specimen was last intact, at most 1. It is 1 until the first sphere is loose.
  double loaded_fraction() const { return loaded_fraction_; }
  double work() const { return work_; }     // J, done by the pressure since the start
  double factor() const { return factor_; } // of Voronoi areas
  // Sum of the area vectors along the outward normals of the shape over its lateral area: 1 if the whole
  // surface is loaded once.
  double coverage(const Particles &particles, const EndPlanes &planes) const;
  std::size_t size() const { return particle_.size(); }
  // Loaded rows, ascending, and how often they were found.
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
  double pressure_ = 0, work_ = 0; // Pa, as given; J
  std::size_t intact_spheres_ = 0; // spheres of loaded pieces, at the start
  double intact_coverage_ = 1, loaded_fraction_ = 1;
  long lists_made_ = 0;
  double moved_ = 0, broken_ = 0; // m, since the areas were found; broken bonds then
  Table table_;
  Column<int> &particle_ = table_.add<int>("particle", "1");
  Column<Vector3> &area_ = table_.add<Vector3>("area", "m2");
};

} // namespace platen::dem
