#include "coupling/contact/contact_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/pi.h"
#include "base/require.h"
#include "base/state.h"
#include "coupling/contact/mesh_indentation.h"

namespace platen::coupling {

namespace {

// Smallest overlap over radius for which the springs of Hertz are computed, as between grains; and the factor
// on the deepest overlap.
constexpr double early_depth = 2e-3, reserve_of_depth = 2;

// One minus the cosine of a normal that still counts as upright.
constexpr double aslant = 1e-9;

void check(const SurfaceContact &p, bool rotation) {
  require(p.hertz || p.particle_stiffness > 0, "surface contact: particle stiffness must be positive");
  require(!p.hertz || (p.hertz->modulus > 0 && p.hertz->tangential_ratio > 0),
          "surface contact: moduli must be positive");
  require(!p.hertz || p.attachment == Attachment::free, "surface contact: Hertz' contact holds nothing");
  require(p.tangential_ratio > 0, "surface contact: tangential stiffness ratio must be positive");
  require(p.friction_static >= 0, "surface contact: static friction must not be negative");
  require(p.dynamic() >= 0, "surface contact: dynamic friction must not be negative");
  using By = dem::Weakening::By;
  require(p.weakening.by == By::nothing || p.dynamic() <= p.friction_static,
          "surface contact: friction that weakens must not grow");
  require(p.weakening.by != By::slip || p.weakening.slip_length > 0,
          "surface contact: slip length must be positive");
  require(p.weakening.by != By::velocity || p.weakening.slip_velocity > 0,
          "surface contact: slip velocity must be positive");
  require(p.bond.strength == 0 || p.bond.strength > 0, "surface contact: bond strength must not be negative");
  if (p.bond.strength > 0) {
    require(!(p.bond.tension <= 0), "surface contact: bond tension must be positive");
    require(p.bond.slip >= 0, "surface contact: bond slip must not be negative");
    require(!p.hertz && p.attachment == Attachment::free && p.weakening.by == By::nothing &&
                p.dynamic() == p.friction_static,
            "surface contact: a bond goes with linear springs and one coefficient of friction");
  }
  require(p.damping >= 0 && std::isfinite(p.damping), "surface contact: damping must not be negative");
  require(p.seat_modulus >= 0 && std::isfinite(p.seat_modulus),
          "surface contact: seat modulus must not be negative");
  require(p.seat_modulus == 0 || rotation, "surface contact: seats need particles that rotate");
  require(p.skin > 0, "surface contact: skin must be positive");
}

std::size_t index(int row) {
  return static_cast<std::size_t>(row);
}

// m, the smaller distance between the middles of two opposite edges of a face.
double narrowest(const fem::SurfaceMesh &surface, int face) {
  const Quad q = face_corners(surface, face, Vector3{});
  return 0.5 * std::sqrt(std::min(norm_squared((q[0] + q[3]) - (q[1] + q[2])),
                                  norm_squared((q[0] + q[1]) - (q[2] + q[3]))));
}

// One row per particle.
void require_ascending(const StateSource &state, const std::string &block) {
  const std::vector<int> particles = rows_of<int>(state, block);
  for (std::size_t k = 1; k < particles.size(); ++k)
    if (particles[k] <= particles[k - 1])
      refuse_row(block, k, std::to_string(particles[k]), "above " + std::to_string(particles[k - 1]));
}

} // namespace

ContactLayer::ContactLayer(const dem::Particles &particles, const fem::LoadedSurface &body,
                           const SurfaceContact &parameters)
    : parameters_(parameters),
      smallest_radius_(std::numeric_limits<double>::infinity()),
      search_(body.surface(), parameters.skin, parameters.instruction_set) {
  check(parameters, particles.has_rotation());
  particle_.allow(row_of(particles.size()));
  require(
      parameters.face_compliance.empty() || parameters.face_compliance.size() == body.surface().faces.size(),
      "surface contact: a compliance of faces needs one entry per face");
  // Inverted twice, as in series with a rigid body: this changes the last bit of an eighth of all numbers,
  // and results have to stay bitwise the same as before.
  stiffness_ = 1 / (1 / parameters.particle_stiffness);
  for (const double r : particles.radius)
    smallest_radius_ = std::min(smallest_radius_, r);
  allow_for_depth();
  const bool friction = parameters.friction_static > 0 || parameters.dynamic() > 0;
  const bool bond = parameters.bond.strength > 0;
  const bool tangential = friction || bond || parameters.attachment == Attachment::glued;
  if (tangential || parameters.seat_modulus > 0)
    normal_ = &table_.add<Vector3>("normal", "1", unit_length_or_zero());
  if (tangential) {
    spring_ = &table_.add<Vector3>("tangential_force", "N");
    sliding_ = &table_.add<int>("sliding", "1", flag());
    slip_ = &table_.add<double>("slip", "m", at_least(0));
    if (parameters.hertz)
      tangential_stiffness_ = &table_.add<double>("tangential_stiffness", "N/m", at_least(0));
  }
  if (bond) bond_ = &table_.add<double>("bond", "1", between(0, 1));
  if (parameters.seat_modulus > 0) {
    seat_spring_ = &table_.add<Vector3>("seat_moment", "N m");
    seat_sliding_ = &table_.add<int>("seat_sliding", "1", flag());
  }
  const bool plain = !parameters.hertz && seat_spring_ == nullptr && !bond &&
                     parameters.attachment == Attachment::free &&
                     (!friction || parameters.weakening.by == dem::Weakening::By::nothing);
  if (plain && parameters.in_lanes) compute_rows_ = kernels::compute_rows(parameters.instruction_set);
}

std::size_t ContactLayer::add_row(int particle) {
  const auto place = std::lower_bound(particle_.begin(), particle_.end(), particle);
  const std::size_t row = static_cast<std::size_t>(place - particle_.begin());
  if (place != particle_.end() && *place == particle) return row;
  const std::size_t last = table_.size();
  table_.resize(last + 1);
  particle_[last] = particle;
  std::vector<int> order(last + 1);
  for (std::size_t k = 0; k <= last; ++k)
    order[k] = static_cast<int>(k < row ? k : (k == row ? last : k - 1));
  table_.permute(order);
  return row;
}

ContactLayer::~ContactLayer() = default;

void ContactLayer::set_friction(const dem::SurfaceFriction &friction) {
  SurfaceContact changed = parameters_;
  static_cast<dem::SurfaceFriction &>(changed) = friction;
  check(changed, true);
  const bool rubs = friction.friction_static > 0 || friction.dynamic() > 0;
  require(!rubs || spring_ != nullptr,
          "surface contact: was made without friction and has no springs for it");
  require(friction.weakening.by == parameters_.weakening.by,
          "surface contact: friction weakens by another law");
  parameters_ = changed;
}

void ContactLayer::seat(int particle, double offset) {
  require(std::isfinite(offset), "surface contact: a seat's offset must be finite");
  const std::size_t row = add_row(particle);
  seated_[row] = 1;
  offset_[row] = offset;
  search_.forget();
}

int ContactLayer::seat_within(const dem::Particles &particles, const fem::LoadedSurface &body, double depth,
                              bool upright, const std::function<double(const Vector3 &)> &below) {
  std::vector<double> reach(particles.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    reach[i] = particles.radius[i] + depth;
  search_.rebuild(body.surface(), particles.position, reach, {});
  int count = 0;
  const std::vector<int> near = search_.particles();
  for (std::size_t k = 0; k < near.size(); ++k) {
    const std::size_t i = index(near[k]);
    const SurfacePoint meets = search_.closest(body.surface(), k, particles.position[i]);
    const double gap = meets.distance - particles.radius[i];
    if (gap > depth || (upright && std::abs(meets.normal.z) < 1 - aslant)) continue;
    seat(near[k], below ? gap - below(particles.position[i]) : gap);
    ++count;
  }
  search_.forget();
  return count;
}

int ContactLayer::seats() const {
  return static_cast<int>(seated_particles().size());
}

void ContactLayer::bond_seats(const dem::Particles &particles, double area) {
  double squares = 0; // m^2
  for (const int particle : seated_particles())
    squares += particles.radius[index(particle)] * particles.radius[index(particle)];
  require(bond_ != nullptr && squares > 0, "surface contact: nothing touches the face that is to be bonded");
  bonded_area_ = area / squares;
  for (std::size_t row = 0; row < table_.size(); ++row)
    (*bond_)[row] = seated_[row];
}

double ContactLayer::bonded_share() const {
  if (bond_ == nullptr) return not_given;
  const auto whole = std::count_if(bond_->begin(), bond_->end(), [](double left) { return left > 0; });
  return static_cast<double>(whole) / seats();
}

std::vector<int> ContactLayer::seated_particles() const {
  std::vector<int> rows;
  for (std::size_t k = 0; k < table_.size(); ++k)
    if (seated_[k]) rows.push_back(particle_[k]);
  return rows;
}

void ContactLayer::moved(double distance) {
  if (!(distance <= smallest_radius_))
    throw std::runtime_error("a particle moved " + std::to_string(distance) +
                             " m against a surface in one step, more than the smallest radius " +
                             std::to_string(smallest_radius_) +
                             " m: it could pass through a face unseen; use a smaller time step");
  search_.moved(distance);
  travelled_ += distance;
}

void ContactLayer::update_search(const dem::Particles &particles, const fem::LoadedSurface &body) {
  if (!search_.stale()) return;
  std::vector<double> reach(particles.radius.begin(), particles.radius.end());
  for (std::size_t k = 0; k < table_.size(); ++k)
    reach[index(particle_[k])] += std::max(0.0, offset_[k]);
  search_.rebuild(body.surface(), particles.position, reach, seated_particles());
  set_rows(search_.particles());
}

void ContactLayer::make_list(const dem::Particles &particles, const fem::LoadedSurface &body) {
  search_.forget();
  update_search(particles, body);
}

// Rows for exactly these particles; those that stay keep their history, new ones start without.
void ContactLayer::set_rows(const std::vector<int> &particles) {
  const std::size_t old_rows = table_.size();
  std::vector<int> order(particles.size());
  int fresh = static_cast<int>(old_rows);
  std::size_t old = 0;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    while (old < old_rows && particle_[old] < particles[k])
      ++old;
    order[k] = old < old_rows && particle_[old] == particles[k] ? static_cast<int>(old) : fresh++;
  }
  find_due_rows_again(order, old_rows);
  table_.resize(static_cast<std::size_t>(fresh));
  table_.permute(order);
  for (std::size_t k = 0; k < particles.size(); ++k)
    particle_[k] = particles[k];
  idle_until_.assign(particles.size(), 0);
}

// The due rows of the last step still hold their results in the history; they get new numbers. A row that
// leaves the list was far from any contact.
void ContactLayer::find_due_rows_again(const std::vector<int> &order, std::size_t old_rows) {
  std::vector<int> now(old_rows, -1);
  for (std::size_t k = 0; k < order.size(); ++k)
    if (index(order[k]) < old_rows) now[index(order[k])] = static_cast<int>(k);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < due_.size(); ++k) {
    if (now[due_[k]] < 0) continue;
    due_[kept] = index(now[due_[k]]);
    results_.move(k, kept);
    if (!moments_.empty()) moments_[kept] = moments_[k];
    ++kept;
  }
  keep_due(kept);
}

void ContactLayer::keep_due(std::size_t count) {
  due_.resize(count), results_.resize(count);
  if (seat_spring_ != nullptr) moments_.resize(count);
}

double ContactLayer::indentation(int face, const std::array<double, 4> &w) const {
  if (parameters_.face_compliance.empty()) return 0;
  const fem::FaceCompliance &c = parameters_.face_compliance[index(face)];
  const auto four = [](const std::array<double, 4> &a) {
    return dem::Rotation<double>{a[0], a[1], a[2], a[3]};
  };
  return indentation_of(four(w), {four(c[0]), four(c[1]), four(c[2]), four(c[3])});
}

double ContactLayer::spring(int face, const std::array<double, 4> &weights) const {
  if (parameters_.face_compliance.empty()) return stiffness_;
  return in_series_with_indentation<dem::OfScalars>(stiffness_, indentation(face, weights));
}

double ContactLayer::stiffness_of(double radius) const {
  return parameters_.hertz ? (*parameters_.hertz)(counted_ * radius, radius).stiffness : stiffness_;
}

double ContactLayer::tangential_ratio() const {
  return parameters_.hertz ? parameters_.hertz->tangential_ratio : parameters_.tangential_ratio;
}

void ContactLayer::allow_for_depth() {
  if (parameters_.hertz) counted_ = std::max(early_depth, reserve_of_depth * deepest_);
}

double ContactLayer::seat_stiffness(double radius) const {
  return 2 * parameters_.seat_modulus * pi * radius * radius * radius / 8;
}

double ContactLayer::stiffest_spring(int face, double radius) const {
  const double total = stiffness_of(radius);
  if (parameters_.face_compliance.empty()) return total;
  // w^T C w is convex, so that no point of the face is softer than the worst of its corners; where that is
  // more than can be taken out, another point is the stiffest.
  const fem::FaceCompliance &c = parameters_.face_compliance[index(face)];
  return in_series_with_indentation<dem::OfScalars>(
      total, std::min(most_indentation / total, std::max({c[0][0], c[1][1], c[2][2], c[3][3]})));
}

std::size_t ContactLayer::bytes() const {
  return table_.size() * table_.bytes_per_row() + results_.bytes() + moments_.capacity() * sizeof(Vector3) +
         search_.bytes();
}

std::vector<dem::GroundSpring> ContactLayer::ground_springs(const dem::Particles &particles,
                                                            const fem::LoadedSurface &body,
                                                            bool with_mesh) const {
  std::vector<dem::GroundSpring> springs;
  for (std::size_t row = 0; row < search_.particles().size(); ++row) {
    const int i = search_.particles()[row];
    const double r = particles.radius[index(i)];
    const SurfacePoint at = search_.closest(body.surface(), row, particles.position[index(i)]);
    dem::GroundSpring spring;
    spring.particle = i;
    spring.normal = at.normal;
    spring.arm = at.local.point;
    spring.normal_stiffness = with_mesh ? stiffness_of(r) : stiffest_spring(at.face, r);
    spring.gap = at.distance - r - (row < table_.size() ? offset_[row] : 0.0);
    if (spring_ != nullptr) spring.tangential_stiffness = tangential_ratio() * spring.normal_stiffness;
    if (seat_spring_ != nullptr && row < table_.size() && seated_[row])
      spring.rotational_stiffness = seat_stiffness(r);
    springs.push_back(spring);
  }
  return springs;
}

fem::VertexSprings ContactLayer::vertex_springs(const dem::Particles &particles,
                                                const fem::Body &body) const {
  const std::size_t vertices = body.surface().vertices.size();
  fem::VertexSprings springs{std::vector<double>(vertices, 0.0), std::vector<double>(vertices, 0.0)};
  for (std::size_t row = 0; row < search_.particles().size(); ++row) {
    const int i = search_.particles()[row];
    const SurfacePoint at = search_.closest(body.surface(), row, particles.position[index(i)]);
    const double r = particles.radius[index(i)], k = stiffest_spring(at.face, r);
    const double stiffest = spring_ != nullptr ? std::max(1.0, tangential_ratio()) * k : k;
    const double dashpot = 2 * parameters_.damping * std::sqrt(stiffness_of(r) * particles.mass[index(i)]);
    // Glued grains give moments without a limit, as forces along the normal on the corners: K = k b b^T for
    // each axis, with b = +- 1 / (2 h) across a width h, so that no row of both has a sum above k / h^2.
    const double h = narrowest(body.surface(), at.face);
    const bool glued = seat_spring_ != nullptr && row < table_.size() && tied(row);
    const double rocking = glued ? seat_stiffness(r) / (h * h) : 0;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::size_t v = index(body.surface().faces[index(at.face)][corner]);
      springs.stiffness[v] += at.local.weights[corner] * stiffest + rocking;
      springs.dashpot[v] += at.local.weights[corner] * dashpot;
    }
  }
  return springs;
}

ServoLoad ContactLayer::servo_load(const dem::Particles &particles) const {
  ServoLoad load;
  for (const int particle : particle_) {
    const double k = stiffness_of(particles.radius[index(particle)]);
    load.stiffness += k;
    load.impedance += std::sqrt(k * particles.mass[index(particle)]);
  }
  return load;
}

void ContactLayer::describe(Archive &archive) {
  archive.version(1);
  archive("friction_work", friction_work, "J");
  archive("damping_work", damping_work, "J");
  archive("closed", closed);
  // Older states do not have it: it is known from the next step on.
  archive("elastic_energy", elastic_energy_, "J", std::numeric_limits<double>::quiet_NaN(), or_nan());
  if (parameters_.hertz) {
    archive("deepest", deepest_, "1", at_least(0));
    archive("counted", counted_, "1", at_least(0));
  }
  archive.table("rows", table_);
  if (const StateSource *state = archive.looks_at()) require_ascending(*state, archive.path("rows/particle"));
  if (!archive.reads()) return;
  search_.forget();
  keep_due(0); // they belong to other rows
}

} // namespace platen::coupling
