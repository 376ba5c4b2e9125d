// The forces on the particles near a surface in a step, row by row.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "coupling/contact/contact_layer.h"
#include "coupling/contact/transfer.h"
#include "dem/laws/rotating_plane.h"

namespace platen::coupling {

using dem::CoulombFriction;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rocking_limit = 0.5; // moment of a seat over N R: the resultant stays within half the radius
const double tsuji = std::sqrt(5.0 / 6.0);                 // with it Hertz' dashpot is a fraction of critical
constexpr std::size_t rows_per_part = SurfacePoints::most; // a row costs as much as some bonds
constexpr std::size_t rows_per_push = 128;                 // of one thread: a microsecond

} // namespace

// Relative motion of particle and surface at the closest point.
struct ContactLayer::Kinematics {
  double gap = 0;           // m
  double opening_speed = 0; // m/s
  Vector3 slide;            // m/s, relative velocity in the contact plane
  Vector3 rocking;          // rad/s, relative rotation in the contact plane; only with seats
  double spin = 0;          // rad/s of the surface about the normal
  double k_n = 0, c_n = 0;  // N/m, N s/m
  double pressing = 0;      // N, of the spring
  double stored = 0;        // J, in it
  double least = 0;         // N, of the normal force: negative where a bond pulls
  double radius = 0;        // m
};

bool ContactLayer::tied(std::size_t row) const {
  return parameters_.attachment == Attachment::glued && seated_[row];
}

bool ContactLayer::holds_history(std::size_t row) const {
  return dashpot_[row] != 0 || (spring_ != nullptr && norm_squared((*spring_)[row]) > 0) ||
         (seat_spring_ != nullptr && norm_squared((*seat_spring_)[row]) > 0);
}

// A row is skipped while its particle cannot have reached the surface since the row was last computed.
void ContactLayer::find_due_rows() {
  const std::size_t rows = table_.size();
  const bool all = own_blocks_.empty();
  due_.resize(rows);
  std::size_t count = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    due_[count] = row;
    count += !(travelled_ < idle_until_[row]) && (all || is_own(row)) ? 1 : 0;
  }
  keep_due(count);
}

void ContactLayer::add_forces(dem::Particles &particles, fem::LoadedSurface &body, double dt) {
  const auto part = [&](std::size_t p) { compute_part(particles, body, dt, p); };
  run_loops(loop_of(prepare(particles, body), part));
  apply_forces(particles, &body);
}

std::size_t ContactLayer::prepare(const dem::Particles &particles, const fem::LoadedSurface &body) {
  update_search(particles, body);
  search_.update(body.surface());
  find_due_rows();
  return number_of_blocks(due_.size(), rows_per_part);
}

void ContactLayer::compute_part(const dem::Particles &particles, const fem::LoadedSurface &body, double dt,
                                std::size_t part) {
  const std::size_t first = part * rows_per_part, last = std::min(due_.size(), first + rows_per_part);
  int at[rows_per_part] = {};
  thread_local SurfacePoints points; // not allocated again for each part
  for (std::size_t k = first; k < last; ++k) {
    const std::size_t i = static_cast<std::size_t>(at[k - first] = particle_[due_[k]]);
    // Prefetched before the search: particles at a surface are far from each other in memory.
    __builtin_prefetch(&particles.velocity[i]);
    __builtin_prefetch(&particles.radius[i]);
    if (parameters_.damping > 0) __builtin_prefetch(&particles.mass[i]);
    if (particles.has_rotation()) __builtin_prefetch(&(*particles.angular_velocity)[i]);
  }
  const Vector3 *position = particles.position.data();
  search_.closest(body.surface(), &due_[first], position, at, last - first, points);
  if (compute_rows_ != nullptr) return compute_in_lanes(particles, body, dt, first, last - first, points);
  for (std::size_t k = first; k < last; ++k) {
    const std::size_t row = due_[k];
    RowForce r;
    r.at = points.at(k - first);
    row_force(particles, body, row, dt, r);
    keep_history(row, r);
    idle_until_[row] = r.idle_until;
    keep_result(k, r, position[at[k - first]]);
  }
}

void ContactLayer::keep_result(std::size_t k, const RowForce &r, const Vector3 &centre) {
  RowLoad &load = results_.load[k];
  load.particle = r.active ? r.particle : -1;
  results_.work[k] = {r.active ? r.elastic : 0, r.friction_loss, r.damping_loss, r.active ? r.depth : -1};
  if (!r.active) return;
  const Vector3 &arm = r.at.local.point;
  load.face = r.at.face;
  load.weights = r.at.local.weights;
  load.force = r.normal_force * r.at.normal + r.shear;
  results_.torque[k] = {cross(arm, load.force) + r.moment, r.normal_force};
  results_.contact[k] = {centre + arm, r.at.normal};
  if (seat_spring_ != nullptr) moments_[k] = r.moment;
}

int ContactLayer::particle_of_part(std::size_t part) const {
  return particle_[due_[part * rows_per_part]];
}

// Each row has its own particle, so that threads do not conflict; the common sums and the body are updated
// later, row by row: the skipped rows may differ from run to run, sums may not. Rows ascend with their
// particles: each thread pushes the particles that it moves.
void ContactLayer::apply_forces(dem::Particles &particles, fem::LoadedSurface *body) {
  const auto push = [&](std::size_t block) {
    const std::size_t last = std::min(results_.size(), (block + 1) * rows_per_push);
    for (std::size_t k = block * rows_per_push; k < last; ++k)
      push_particle(particles, k);
  };
  const auto serve = [&](std::size_t piece) {
    if (piece == 0)
      sum_rows();
    else
      load_body(*body);
  };
  run_loops(loop_of(number_of_blocks(results_.size(), rows_per_push), push),
            loop_of(body != nullptr ? 2 : 1, serve));
}

void ContactLayer::push_particle(dem::Particles &particles, std::size_t k) const {
  const RowLoad &load = results_.load[k];
  if (load.particle < 0) return;
  const std::size_t i = static_cast<std::size_t>(load.particle);
  particles.force[i] += load.force;
  if (particles.has_rotation()) (*particles.torque)[i] += results_.torque[k].torque;
}

void ContactLayer::load_body(fem::LoadedSurface &body) const {
  for (std::size_t k = 0; k < results_.size(); ++k) {
    const RowLoad &load = results_.load[k];
    if (load.particle < 0) continue;
    body.add_face_force(load.face, load.weights, -load.force);
    if (seat_spring_ != nullptr && norm_squared(moments_[k]) > 0) apply_moment(body, load.face, -moments_[k]);
  }
}

void ContactLayer::sum_rows() {
  std::size_t active = 0;
  double elastic = 0, friction_loss = 0, damping_loss = 0, deepest = 0;
  for (const RowWork &row : results_.work) {
    friction_loss += row.friction_loss;
    damping_loss += row.damping_loss;
    elastic += row.elastic;
    active += row.depth >= 0 ? 1 : 0;
    deepest = std::max(deepest, row.depth);
  }
  closed = active;
  elastic_energy_ = elastic;
  deepest_ = deepest;
  friction_work += friction_loss;
  damping_work += damping_loss;
}

void ContactLayer::keep_history(std::size_t row, RowForce &r) {
  dashpot_[row] = r.dashpot;
  if (normal_ != nullptr) (*normal_)[row] = r.active ? r.at.normal : Vector3{};
  if (spring_ != nullptr) {
    (*spring_)[row] = r.spring.spring;
    (*sliding_)[row] = r.spring.sliding;
    (*slip_)[row] = r.active ? (*slip_)[row] + r.slip : 0;
    if (bond_ != nullptr) (*bond_)[row] = r.bond;
    if (tangential_stiffness_ != nullptr) (*tangential_stiffness_)[row] = r.tangential_stiffness;
  }
  if (seat_spring_ != nullptr) {
    (*seat_spring_)[row] = r.seat.spring;
    (*seat_sliding_)[row] = r.seat.sliding;
  }
}

// Reads the row's history and writes nothing but its own result.
void ContactLayer::row_force(const dem::Particles &particles, const fem::LoadedSurface &body, std::size_t row,
                             double dt, RowForce &result) {
  const std::size_t i = static_cast<std::size_t>(particle_[row]);
  result.particle = particle_[row];
  Kinematics motion;
  motion.radius = particles.radius[i];
  motion.gap = result.at.distance - particles.radius[i] - offset_[row];
  result.active = motion.gap < 0 || tied(row) || bonded(row);
  if (!result.active && !holds_history(row)) {
    result.idle_until = travelled_ + (1 - idle_margin) * motion.gap;
    return;
  }

  const Vector3 arm = result.at.local.point, &n = result.at.normal;
  const Vector3 spin = particles.has_rotation() ? (*particles.angular_velocity)[i] : Vector3{};
  const SurfaceMotion surface = surface_motion(body.surface(), result.at);
  const Vector3 v = particles.velocity[i] + cross(spin, arm) - surface.velocity;
  motion.opening_speed = dot(v, n);
  motion.slide = v - motion.opening_speed * n;
  motion.spin = surface.spin;
  if (parameters_.hertz && particles.has_rotation()) motion.spin = 0.5 * (surface.spin + dot(spin, n));
  press(result.at, particles.mass[i], motion);
  if (parameters_.hertz && result.active) result.depth = -motion.gap / motion.radius;
  if (bonded(row)) {
    result.bond = bond_of(motion.radius).left_at(motion.gap, (*bond_)[row], motion.k_n);
    pull(result.bond, motion);
  }
  normal_force(row, motion, dt, result);
  if (spring_ != nullptr) tangential_force(row, motion, dt, result);
  if (bonded(row) && result.bond < (*bond_)[row]) weaken(row, motion, dt, result);
  if (seat_spring_ != nullptr && seated_[row]) {
    const Vector3 w = spin - face_rotation(body.surface(), result.at.face);
    motion.rocking = w - dot(w, n) * n;
    seat_moment(row, motion, dt, result);
  }
}

// The spring without its dashpot, and the dashpot's coefficient.
void ContactLayer::press(const SurfacePoint &at, double mass, Kinematics &motion) const {
  if (!parameters_.hertz) {
    motion.k_n = spring(at.face, at.local.weights);
    if (parameters_.damping > 0) motion.c_n = 2 * parameters_.damping * std::sqrt(stiffness_ * mass);
    motion.pressing = -motion.k_n * motion.gap;
    motion.stored = 0.5 * motion.k_n * motion.gap * motion.gap;
    return;
  }
  if (!(motion.gap < 0)) return;
  const dem::HertzOnPlane::Response r =
      (*parameters_.hertz)(-motion.gap, motion.radius, indentation(at.face, at.local.weights));
  motion.k_n = r.stiffness;
  motion.c_n = 2 * tsuji * parameters_.damping * std::sqrt(r.stiffness * mass);
  motion.pressing = r.force;
  motion.stored = r.energy;
}

// The work of the dashpot by the trapezoid rule, consistent with the leapfrog. Where the sum is cut off at
// zero the dashpot has cancelled the spring's force, and the energy that the spring releases is lost to it.
void ContactLayer::normal_force(std::size_t row, const Kinematics &motion, double dt, RowForce &result) {
  if (result.active) {
    result.normal_force = motion.pressing - motion.c_n * motion.opening_speed;
    if (!tied(row)) result.normal_force = std::max(motion.least, result.normal_force);
    result.dashpot = result.normal_force - motion.pressing;
    result.elastic = motion.stored;
  }
  result.damping_loss = -0.5 * (dashpot_[row] + result.dashpot) * motion.opening_speed * dt;
}

// N/m, of a contact that is closed or was in the last step. Where it has become softer the spring keeps its
// stretch, where stiffer its force: both only lose energy. The leapfrog saw the previous force over half of
// the stretch (m).
double ContactLayer::tangential_spring(std::size_t row, const Kinematics &motion, const Vector3 &stretch,
                                       Vector3 &spring, RowForce &result) {
  if (!parameters_.hertz) return parameters_.tangential_ratio * motion.k_n;
  const double before = (*tangential_stiffness_)[row];
  if (!result.active) return before;
  const double now = result.tangential_stiffness = parameters_.hertz->tangential_ratio * motion.k_n;
  if (!(before > 0)) return now;
  const double stored = 0.5 * norm_squared(spring) / before;
  const Vector3 seen = spring;
  if (now < before) spring *= now / before;
  const double left = now > 0 ? 0.5 * norm_squared(spring) / now : 0;
  result.friction_loss += stored - left + 0.5 * dot(seen - spring, stretch);
  return now;
}

void ContactLayer::tangential_force(std::size_t row, const Kinematics &motion, double dt, RowForce &result) {
  const Vector3 &n = result.at.normal;
  const bool touched = norm_squared((*normal_)[row]) > 0;
  CoulombFriction::State state{(*spring_)[row], (*sliding_)[row], (*slip_)[row]};
  if (touched)
    state.spring =
        dem::spin_in_plane(dem::carry_with_plane(state.spring, (*normal_)[row], n), n, motion.spin * dt);
  const Vector3 stretch = -dt * motion.slide;
  const double k_t = tangential_spring(row, motion, stretch, state.spring, result);
  if (!(k_t > 0)) return; // of Hertz: neither now nor before
  // Glue has no limit, so that any pressing force will do.
  const CoulombFriction glue{{infinite, infinite}};
  const double pressing = tied(row) ? 1 : (result.active ? result.normal_force : 0);
  const dem::FrictionLaw friction = dem::friction_law(parameters_);
  const CoulombFriction *constant = tied(row) ? &glue : std::get_if<CoulombFriction>(&friction);
  const CoulombFriction::Result t =
      bonded(row)           ? bond_of(motion.radius)(state, result.bond, stretch, pressing, k_t)
      : constant != nullptr ? (*constant)(state, stretch, pressing, k_t)
                            : dem::slide_weakening(friction, state, stretch, pressing, k_t, dt);
  result.spring = state;
  result.shear = t.force;
  result.slip = t.slip;
  result.friction_loss += t.dissipated;
  result.elastic += 0.5 * norm_squared(t.force) / k_t;
}

// With this part of the bond left.
void ContactLayer::pull(double left, Kinematics &motion) const {
  const dem::CohesiveFriction bond = bond_of(motion.radius);
  motion.least = -left * bond.parameters.tension;
  if (!(motion.gap > 0)) return;
  const double stiffness = bond.stiffness(left, motion.k_n);
  motion.pressing = -stiffness * motion.gap;
  motion.stored = 0.5 * stiffness * motion.gap * motion.gap;
}

// A bond that has become weaker in this step, by its opening or its slip. The leapfrog saw the mean of its
// forces before and after; what its spring lost beside counts as friction.
void ContactLayer::weaken(std::size_t row, Kinematics &motion, double dt, RowForce &result) {
  const double sheared = result.elastic - motion.stored; // J
  pull(result.bond, motion);
  result.active = motion.gap < 0 || result.bond > 0;
  result.dashpot = 0;
  normal_force(row, motion, dt, result);
  result.elastic += sheared;
  if (!(motion.gap > 0)) return;
  const double way = motion.opening_speed * dt, gap = motion.gap - way; // m, the latter before the step
  const double stiffness = gap > 0 ? bond_of(motion.radius).stiffness((*bond_)[row], motion.k_n) : motion.k_n;
  result.friction_loss +=
      0.5 * stiffness * gap * gap - motion.stored + 0.5 * (stiffness * gap - motion.pressing) * way;
}

dem::CohesiveFriction ContactLayer::bond_of(double radius) const {
  const SurfaceBond &bond = parameters_.bond;
  const double area = bonded_area_ * radius * radius; // m^2
  return {{parameters_.friction_static, bond.strength * area,
           (std::isnan(bond.tension) ? bond.strength : bond.tension) * area, bond.slip}};
}

// A flat end of a ground sphere rocks on an elastic base: a spring with a limit, the law of friction with
// angles for displacements and R/2 for the coefficient.
void ContactLayer::seat_moment(std::size_t row, const Kinematics &motion, double dt, RowForce &result) {
  const Vector3 &n = result.at.normal;
  const double stiffness = seat_stiffness(motion.radius);
  double limit = rocking_limit * motion.radius, pressing = result.active ? result.normal_force : 0;
  if (tied(row)) {
    limit = infinite;
    pressing = 1;
  }
  CoulombFriction::State state{(*seat_spring_)[row], (*seat_sliding_)[row]};
  if (norm_squared((*normal_)[row]) > 0)
    state.spring =
        dem::spin_in_plane(dem::carry_with_plane(state.spring, (*normal_)[row], n), n, motion.spin * dt);
  const CoulombFriction::Result m =
      CoulombFriction{{limit, limit}}(state, -dt * motion.rocking, pressing, stiffness);
  result.seat = state;
  result.moment = m.force;
  result.friction_loss += m.dissipated;
  result.elastic += 0.5 * norm_squared(m.force) / stiffness;
}

std::vector<ActiveContact> ContactLayer::contacts() const {
  std::vector<ActiveContact> active;
  for (std::size_t k = 0; k < results_.size(); ++k) {
    const RowLoad &load = results_.load[k];
    if (load.particle < 0) continue;
    ActiveContact c;
    c.particle = load.particle, c.face = load.face;
    c.point = results_.contact[k].point, c.normal = results_.contact[k].normal;
    c.normal_force = results_.torque[k].normal_force;
    if (spring_ != nullptr) {
      c.shear = (*spring_)[due_[k]];
      c.sliding = (*sliding_)[due_[k]] != 0;
      c.slip = (*slip_)[due_[k]];
    }
    active.push_back(c);
  }
  return active;
}

std::vector<double> ContactLayer::vertex_slip(const fem::LoadedSurface &body) const {
  std::vector<double> sum(body.surface().vertices.size()), weight(sum.size());
  if (slip_ == nullptr) return sum;
  for (std::size_t k = 0; k < results_.size(); ++k) {
    const RowLoad &load = results_.load[k];
    if (load.particle < 0) continue;
    const auto &corners = body.surface().faces[static_cast<std::size_t>(load.face)];
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::size_t v = static_cast<std::size_t>(corners[corner]);
      sum[v] += load.weights[corner] * (*slip_)[due_[k]];
      weight[v] += load.weights[corner];
    }
  }
  // Weights below this are round-off of a contact on the far edge of the face.
  constexpr double no_weight = 1e-12;
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] = weight[v] > no_weight ? sum[v] / weight[v] : 0;
  return sum;
}

} // namespace platen::coupling
