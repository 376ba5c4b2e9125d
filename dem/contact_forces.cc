// The loop over contacts, once for every choice of effects.
#include <cmath>
#include <stdexcept>

#include "base/parallel.h"
#include "dem/contacts.h"
#include "dem/kernels/contact_kernel.h"
#include "dem/laws/coulomb_friction.h"
#include "dem/laws/normal_contact.h"
#include "dem/laws/rotating_plane.h"

namespace platen::dem {
// What a loop has. `ledger`: sums of what is lost, which cost a loop without them up to 15 % if they are but
// asked for (bench/results/effects.md).
template <class NormalLaw, TangentialContact tangential, bool with_dashpots, bool with_rotation,
          bool with_ledger>
struct Contacts::With {
  using Law = NormalLaw;
  static constexpr bool friction = tangential != TangentialContact::none,
                        rolling = tangential == TangentialContact::coulomb_with_rolling,
                        dashpots = with_dashpots, rotation = with_rotation, ledger = with_ledger;
};

struct Contacts::Touch {
  std::size_t i, j;
  Vector3 n, slip_velocity; // m/s
  double pressing, kn;      // N, N/m
  double spun;              // rad, both about n in this step
  Vector3 force, drag;      // N, on the first; drag: the dashpots' part
};

void Contacts::compute(Particles &particles, double dt, const BlockList *listed) {
  cut_blocks(particles);
  if (table.size() == 0) return;
  std::vector<Dissipation> lost(blocks_.blocks());
  for_listed_blocks(listed, particles.size(), [&](std::size_t, std::size_t, std::size_t block) {
    if (blocks_.first_pair[block] < blocks_.first_pair[block + 1])
      lost[block] = (this->*loop_)(particles, dt, block);
  });
  for (const Dissipation &l : lost) {
    friction_work += l.friction;
    damping_work += l.damping;
  }
}

// In memory of this thread, until it asks again.
Contacts::RowsAtWork Contacts::rows_at_work(const Particles &p, std::size_t block) const {
  thread_local std::vector<int> memory;
  const std::size_t from = blocks_.first_pair[block], to = blocks_.first_pair[block + 1];
  if (memory.size() < to - from) memory.resize(to - from);
  const kernels::ContactKernel find = for_set(instruction_set_, kernels::rows_at_work_baseline,
                                              kernels::rows_at_work_avx2, kernels::rows_at_work_avx512);
  const kernels::ContactColumns columns{first.data(), second.data(), rest_distance.data(), touching.data(),
                                        p.position.data()};
  return {memory.data(), find(columns, from, to, memory.data())};
}

// The rows of one block of particles; their forces go to the particles and the ghosts of the block.
template <class Effects>
Contacts::Dissipation Contacts::compute_block(Particles &p, double dt, std::size_t block) {
  using Law = typename Effects::Law;
  Dissipation lost;
  const std::size_t first_ghost = blocks_.first_ghost[block];
  const std::size_t ghosts = blocks_.first_ghost[block + 1] - first_ghost;
  std::fill_n(blocks_.ghost_force.data() + first_ghost, ghosts, Vector3{});
  if constexpr (Effects::rotation) std::fill_n(blocks_.ghost_torque.data() + first_ghost, ghosts, Vector3{});
  const std::size_t first_row = block * block_rows, rows = std::min(block_rows, p.size() - first_row);
  const RowsAtWork at_work = rows_at_work(p, block);
  for (std::size_t n = 0; n < at_work.count; ++n) {
    const std::size_t k = static_cast<std::size_t>(at_work.row[n]);
    Touch t{};
    t.i = static_cast<std::size_t>(first[k]), t.j = static_cast<std::size_t>(second[k]);
    const Vector3 d = p.position[t.j] - p.position[t.i];
    const double square = norm_squared(d);
    if (square >= rest_distance[k] * rest_distance[k]) {
      if (touching[k]) release<Effects>(k, lost);
      continue;
    }
    const double length = std::sqrt(square), lever = p.radius[t.i] / (p.radius[t.i] + p.radius[t.j]);
    t.n = d / length;
    const Vector3 ri = lever * d, rj = ri - d;
    Vector3 v = p.velocity[t.j] - p.velocity[t.i];
    if constexpr (Effects::rotation)
      v += cross((*p.angular_velocity)[t.j], rj) - cross((*p.angular_velocity)[t.i], ri);
    if constexpr (Effects::rotation)
      t.spun = 0.5 * dt * dot((*p.angular_velocity)[t.i] + (*p.angular_velocity)[t.j], t.n);
    const double vn = dot(v, t.n);
    touching[k] = 1;
    overlap[k] = rest_distance[k] - length;
    const double elastic = Law::force(coefficient[k], overlap[k]);
    t.kn = Law::stiffness(coefficient[k], overlap[k]);
    t.pressing = elastic;
    if constexpr (Effects::dashpots) // no attraction
      t.pressing =
          std::max(0.0, elastic - 2 * dashpot_ * std::sqrt(t.kn * reduced(p.mass[t.i], p.mass[t.j])) * vn);
    t.force = -t.pressing * t.n;
    t.drag = (elastic - t.pressing) * t.n;
    t.slip_velocity = v - vn * t.n;
    if constexpr (Effects::rolling) rolling_moment<Effects>(p, dt, k, t, lost);
    if constexpr (Effects::friction) tangential_force<Effects>(p, dt, k, t, lost);
    if constexpr (Effects::dashpots) {
      // By the mean of the forces at the two ends of the drift, as the leapfrog sees it.
      if constexpr (Effects::ledger) lost.damping += 0.5 * dt * dot(t.drag + (*dashpot)[k], v);
      (*dashpot)[k] = t.drag;
    }
    force[k] = t.force;
    const std::size_t local = static_cast<std::size_t>(blocks_.ends[k].second);
    const bool inside = local < rows;
    const std::size_t ghost = first_ghost + local - rows;
    p.force[t.i] += t.force;
    (inside ? p.force[t.j] : blocks_.ghost_force[ghost]) -= t.force;
    if constexpr (Effects::rotation) {
      Vector3 on_first = cross(ri, t.force), on_second = -cross(rj, t.force);
      if constexpr (Effects::rolling) {
        on_first += (*rolling)[k];
        on_second -= (*rolling)[k];
      }
      (*p.torque)[t.i] += on_first;
      (inside ? (*p.torque)[t.j] : blocks_.ghost_torque[ghost]) += on_second;
    }
  }
  return lost;
}

// A vector in the plane of contact k as the last step left it, turned with the plane and with the pair about
// its normal.
Vector3 Contacts::turned(const Vector3 &vector, std::size_t k, const Touch &t) const {
  return spin_in_plane(carry_with_plane(vector, (*normal)[k], t.n), t.n, t.spun);
}

// Coulomb's spring in the turned contact plane.
template <class Effects>
void Contacts::tangential_force(const Particles &p, double dt, std::size_t k, Touch &t, Dissipation &lost) {
  double &kt = (*tangential_stiffness)[k];
  CoulombFriction::State state{turned((*spring)[k], k, t), (*sliding)[k]};
  if constexpr (!Effects::Law::constant_stiffness) {
    // A softer spring keeps its stretch, a stiffer one its force: both only lose energy, and the ledger gets
    // it, with what the mean force over the step has done by the part that is gone.
    const double now = Effects::Law::tangential_ratio(settings_) * t.kn;
    const double before = 0.5 * norm_squared(state.spring) / kt;
    const Vector3 seen = state.spring;
    if (now < kt) state.spring *= now / kt;
    if (Effects::ledger && kt > 0 && norm_squared(state.spring) > 0)
      lost.friction += before - 0.5 * norm_squared(state.spring) / now +
                       0.5 * dt * dot(seen - state.spring, t.slip_velocity);
    kt = now;
  }
  const CoulombFriction friction{{settings_.friction, settings_.friction}};
  const CoulombFriction::Result result = friction(state, dt * t.slip_velocity, t.pressing, kt);
  if constexpr (Effects::ledger) lost.friction += result.dissipated;
  (*sliding)[k] = state.sliding;
  (*spring)[k] = state.spring;
  (*normal)[k] = t.n;
  t.force += result.force;
  if constexpr (Effects::dashpots) {
    if (state.sliding) return;
    // Spring and dashpot together stay below the Coulomb limit too; a contact that is not pressed drags
    // nothing.
    const double c = 2 * dashpot_ * std::sqrt(kt * reduced(p.mass[t.i], p.mass[t.j]));
    Vector3 tangential = state.spring + c * t.slip_velocity;
    const double size = norm(tangential), limit = settings_.friction * t.pressing;
    if (size > limit) tangential *= limit / size;
    t.force += tangential - state.spring;
    t.drag += tangential - state.spring;
  }
}

// The same law turns a rolling spring k_t R*^2 with the limit rolling_friction R* N. Called before the
// tangential force, which renews the normal.
template <class Effects>
void Contacts::rolling_moment(const Particles &p, double dt, std::size_t k, const Touch &t,
                              Dissipation &lost) {
  const double effective = reduced(p.radius[t.i], p.radius[t.j]);
  const double stiffness = (*rolling_stiffness)[k] = (*tangential_stiffness)[k] * effective * effective;
  if (!(stiffness > 0)) return; // Hertz' contact at its first step
  const Vector3 w = (*p.angular_velocity)[t.j] - (*p.angular_velocity)[t.i];
  const double limit = settings_.rolling_friction * effective;
  CoulombFriction::State state{turned((*rolling)[k], k, t), 0};
  const CoulombFriction::Result result =
      CoulombFriction{{limit, limit}}(state, dt * (w - dot(w, t.n) * t.n), t.pressing, stiffness);
  if constexpr (Effects::ledger) lost.friction += result.dissipated;
  (*rolling)[k] = state.spring;
}

template <class Effects>
void Contacts::release(std::size_t k, Dissipation &lost) {
  touching[k] = 0;
  overlap[k] = 0;
  force[k] = {};
  if constexpr (Effects::friction) {
    const double kt = (*tangential_stiffness)[k];
    if (Effects::ledger && kt > 0) lost.friction += 0.5 * norm_squared((*spring)[k]) / kt;
    (*spring)[k] = {};
    (*sliding)[k] = 0;
  }
  if constexpr (Effects::dashpots) (*dashpot)[k] = {};
  if constexpr (Effects::rolling) {
    if (Effects::ledger && (*rolling_stiffness)[k] > 0)
      lost.friction += 0.5 * norm_squared((*rolling)[k]) / (*rolling_stiffness)[k];
    (*rolling)[k] = {};
  }
}

// Choices are made one after the other, in the order of With.
template <class Law, TangentialContact tangential, bool... chosen>
Contacts::Loop Contacts::choose(const std::array<bool, 3> &effects) {
  constexpr std::size_t made = sizeof...(chosen);
  if constexpr (made < 3) {
    return effects[made] ? choose<Law, tangential, chosen..., true>(effects)
                         : choose<Law, tangential, chosen..., false>(effects);
  } else {
    using Effects = With<Law, tangential, chosen...>;
    if constexpr (Effects::rolling && !Effects::rotation)
      throw std::invalid_argument("rolling resistance needs particles that rotate");
    else
      return &Contacts::compute_block<Effects>;
  }
}

Contacts::Loop Contacts::loop_for(const std::array<bool, 3> &effects) {
  return NormalContacts::with(settings_.normal, [&](auto of) {
    using Law = decltype(of);
    switch (settings_.tangential) {
      case TangentialContact::coulomb_with_rolling:
        return choose<Law, TangentialContact::coulomb_with_rolling>(effects);
      case TangentialContact::coulomb:
        return choose<Law, TangentialContact::coulomb>(effects);
      case TangentialContact::none:
        break;
    }
    return choose<Law, TangentialContact::none>(effects);
  });
}

} // namespace platen::dem
