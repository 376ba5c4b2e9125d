#include "dem/confinement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/pi.h"
#include "dem/measure/damage.h"
#include "dem/measure/fragments.h"

namespace platen::dem {
namespace {

constexpr double fraction_of_body = 0.05; // fraction of the spheres; smaller pieces are not loaded
constexpr double move_of_areas = 0.05;    // mean radii
constexpr double depth_of_spheres = 1.0;  // mean radii, between a lateral sphere's surface and the wall

std::vector<char> body_of(const Particles &p, const Bonds *bonds) {
  std::vector<char> body(p.size(), 1);
  if (bonds == nullptr) return body;
  const Fragments pieces = find_fragments(p, bonds);
  const double least = fraction_of_body * static_cast<double>(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    body[i] = pieces.particles[pieces.of_particle[i]] >= least;
  return body;
}

double broken_bonds(const Bonds *bonds) {
  if (bonds == nullptr) return 0;
  return static_cast<double>(std::count_if(bonds->state.begin(), bonds->state.end(), is_broken));
}

// Distance from the lateral surface inwards, m.
double lateral_clearance(const Shape &s, const Vector3 &x) {
  if (s.kind == ShapeKind::cylinder) return s.radius - std::hypot(x.x, x.y);
  return std::min(0.5 * s.width_x - std::abs(x.x), 0.5 * s.width_y - std::abs(x.y));
}

} // namespace

Confinement::Confinement(const Particles &p, const Bonds *bonds, const Shape &shape, const EndPlanes &planes,
                         ConfinementArea kind)
    : shape_(shape), kind_(kind) {
  for (const double r : p.radius)
    mean_radius_ += r / static_cast<double>(std::max<std::size_t>(p.size(), 1));
  const std::vector<char> body = body_of(p, bonds);
  intact_spheres_ = static_cast<std::size_t>(std::count(body.begin(), body.end(), 1));
  particle_.allow(row_of(p.size()));
  find(p, bonds, planes);
  const double found = coverage(p, planes);
  if (!(found > 0))
    throw std::invalid_argument("the specimen has no lateral skin that a pressure could act on");
  if (kind_ == ConfinementArea::sphere) return;
  factor_ = 1 / found;
  for (Vector3 &a : area_)
    a *= factor_;
  intact_coverage_ = coverage(p, planes);
}

// The part of an area vector along the outward normal of the shape's lateral surface there. At the edge of a
// box both faces contribute.
Vector3 Confinement::outward(const Vector3 &area, const Vector3 &x) const {
  if (shape_.kind == ShapeKind::cylinder) {
    const double r = std::hypot(x.x, x.y);
    if (!(r > 0)) return {};
    const Vector3 n{x.x / r, x.y / r, 0};
    return dot(area, n) * n;
  }
  const double depth = 4 * mean_radius_; // of a face's skin
  Vector3 out;
  if (0.5 * shape_.width_x - std::abs(x.x) < depth) out.x = area.x;
  if (0.5 * shape_.width_y - std::abs(x.y) < depth) out.y = area.y;
  return out;
}

double Confinement::coverage(const Particles &p, const EndPlanes &planes) const {
  double sum = 0;
  for (std::size_t k = 0; k < particle_.size(); ++k) {
    const Vector3 x = p.position[particle_[k]], a = outward(area_[k], x);
    if (shape_.kind == ShapeKind::cylinder)
      sum += std::copysign(norm(a), a.x * x.x + a.y * x.y);
    else
      sum += std::copysign(1.0, x.x) * a.x + std::copysign(1.0, x.y) * a.y;
  }
  return sum / (lateral_perimeter(shape_) * (planes.high - planes.low));
}

Skin Confinement::sphere_skin(const Particles &p, const std::vector<char> &body) const {
  Skin skin;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double gap = lateral_clearance(shape_, p.reference_position[i]) - p.radius[i];
    if (!body[i] || gap > depth_of_spheres * mean_radius_) continue;
    const Vector3 x = p.position[i];
    Vector3 n{x.x, x.y, 0};
    if (shape_.kind == ShapeKind::box) {
      const Vector3 &X = p.reference_position[i];
      const bool along_x = 0.5 * shape_.width_x - std::abs(X.x) < 0.5 * shape_.width_y - std::abs(X.y);
      n = along_x ? Vector3{X.x, 0, 0} : Vector3{0, X.y, 0};
    }
    const double length = norm(n);
    if (!(length > 0)) continue;
    skin.particle.push_back(static_cast<int>(i));
    skin.area.push_back(pi * p.radius[i] * p.radius[i] / length * n);
  }
  return skin;
}

void Confinement::find(const Particles &p, const Bonds *bonds, const EndPlanes &planes) {
  const std::vector<char> body = body_of(p, bonds);
  Skin skin = kind_ == ConfinementArea::voronoi ? find_skin(p, body, planes) : sphere_skin(p, body);
  balance(skin, p);
  table_.resize(skin.particle.size());
  for (std::size_t k = 0; k < skin.particle.size(); ++k) {
    particle_[k] = skin.particle[k];
    area_[k] = factor_ * skin.area[k];
  }
  moved_ = 0;
  ++lists_made_;
  broken_ = broken_bonds(bonds);
  // A specimen only loses spheres: an equal number means the same spheres.
  const double now = coverage(p, planes);
  if (static_cast<std::size_t>(std::count(body.begin(), body.end(), 1)) == intact_spheres_)
    intact_coverage_ = now;
  loaded_fraction_ = std::min(1.0, now / intact_coverage_);
}

// Sum of a.v, m^3/s: rate of the volume increase of the specimen.
double Confinement::power(const Particles &p) const {
  double sum = 0;
  for (std::size_t k = 0; k < particle_.size(); ++k)
    sum += dot(area_[k], p.velocity[particle_[k]]);
  return sum;
}

// Work by the trapezoidal rule over the drift: old areas and pressure at its beginning, new ones at its end.
void Confinement::update(const Particles &p, const Bonds *bonds, const EndPlanes &planes, double dt,
                         double distance, bool due) {
  moved_ += distance;
  work_ -= 0.5 * dt * pressure_ * power(p);
  if (due && (moved_ > move_of_areas * mean_radius_ || broken_bonds(bonds) != broken_))
    find(p, bonds, planes);
}

void Confinement::add_forces(Particles &p, double pressure, double dt) {
  pressure_ = pressure;
  work_ -= 0.5 * dt * pressure_ * power(p);
  for (std::size_t k = 0; k < particle_.size(); ++k)
    p.force[particle_[k]] -= pressure_ * area_[k];
}

void Confinement::describe(Archive &archive) {
  archive.version(1);
  archive("pressure", pressure_, "Pa");
  archive("work", work_, "J");
  archive("moved", moved_, "m", at_least(0));
  archive("broken_bonds", broken_, "1", at_least(0));
  archive("whole_coverage", intact_coverage_, "1", 1.0);
  archive("loaded_share", loaded_fraction_, "1", 1.0);
  archive.table("areas", table_);
}

} // namespace platen::dem
