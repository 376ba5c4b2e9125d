// Body of the contact kernels; the including file sets PLATEN_LANES and PLATEN_KERNELS. Compiled without
// contraction, so that every instruction set gives the same bits.
#include <stdexcept>

#include "dem/kernels/contact_kernel.h"
#include "dem/kernels/lane_friction.inc.h"
#include "dem/laws/normal_contact.h"

namespace platen::dem::kernels {
namespace {

// Bit mask of the next rows that touched.
PLATEN_INLINE unsigned set_lanes(const int *from) {
#if PLATEN_LANES == 8
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(from));
  return _mm256_test_epi32_mask(all, all);
#else
  unsigned bits = 0;
  for (int l = 0; l < lanes; ++l)
    bits |= (from[l] != 0 ? 1u : 0u) << l;
  return bits;
#endif
}

PLATEN_INLINE unsigned lanes_at_work(const ContactColumns &c, std::size_t k) {
  const Triple<Simd> d = gather_difference(c.position, c.second + k, c.first + k);
  const Simd rest = load(c.rest_distance + k);
  const Simd square = d.x * d.x + d.y * d.y + d.z * d.z;
  return (all_lanes & ~lanes_at_least(square, rest * rest)) | set_lanes(c.touching + k);
}

PLATEN_INLINE bool is_close(const ContactColumns &c, std::size_t k) {
  const Vector3 &a = c.position[c.first[k]], &b = c.position[c.second[k]];
  const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, rest = c.rest_distance[k];
  return !(x * x + y * y + z * z >= rest * rest);
}

std::size_t rows_at_work(const ContactColumns &c, std::size_t first, std::size_t last, int *rows) {
  std::size_t found = 0, k = first;
  for (; k + lanes <= last; k += lanes)
    for (unsigned bits = lanes_at_work(c, k); bits != 0; bits &= bits - 1)
      rows[found++] = static_cast<int>(k) + __builtin_ctz(bits);
  for (; k < last; ++k)
    if (is_close(c, k) || c.touching[k] != 0) rows[found++] = static_cast<int>(k);
  return found;
}

// Active rows of a block, in the order of their pairs.
std::size_t rows_at_work(const ContactColumns &c, const ContactBlock &b, int *rows) {
  const auto comes_before = [&](int k, int l) {
    return c.first[k] != c.first[l] ? c.first[k] < c.first[l] : c.second[k] < c.second[l];
  };
  std::size_t found = rows_at_work(c, b.first_pair, b.end_pair, rows);
  for (std::size_t n = 0; n < b.added_count; ++n) {
    const int row = b.added[n];
    if (!is_close(c, static_cast<std::size_t>(row)) && c.touching[row] == 0) continue;
    std::size_t at = found++;
    for (; at > 0 && comes_before(row, rows[at - 1]); --at)
      rows[at] = rows[at - 1];
    rows[at] = row;
  }
  return found;
}

// Effects of a loop. `ledger`: sums of lost energies; testing for them at run time costs a loop without them
// up to 15 % (bench/results/effects.md).
template <class NormalLaw, TangentialContact tangential, bool with_rotation, bool with_ledger>
struct With {
  using Law = NormalLaw;
  static constexpr bool friction = tangential != TangentialContact::none,
                        rolling = tangential == TangentialContact::coulomb_with_rolling,
                        rotation = with_rotation, ledger = with_ledger;
};

PLATEN_INLINE Simd reduced_of(const Simd &a, const Simd &b) {
  return a * b / (a + b);
}

// A SIMD vector of rows that touch. Lanes from `count` on repeat the last row and are not written.
struct Touch {
  int row[lanes], i[lanes], j[lanes], count;
  Triple<Simd> n, ri, rj, slip_velocity; // m, m/s
  Simd pressing, kn, spun;               // N, N/m, rad: mean turn about n in this step
  Triple<Simd> force, drag;              // N, on the first; drag: the dashpots' part
};

// J, of each lane: rolling, softening of a spring, sliding, dashpots.
struct Losses {
  Simd rolling = Simd(0.0), softened = Simd(0.0), sliding = Simd(0.0), damping = Simd(0.0);
};

// A vector in the contact plane of the last step, rotated with the plane and with the pair about its normal.
PLATEN_INLINE Triple<Simd> turned(const ContactColumns &c, const Vector3 *column, const Touch &t) {
  return spin_in_plane(carried_with_plane<OfLanes>(gather(column, t.row), gather(c.normal, t.row), t.n), t.n,
                       t.spun);
}

// Rolling spring k_t R*^2 with the friction limit rolling_friction R* N. To call before the tangential force,
// which overwrites the normal.
template <class Effects>
PLATEN_INLINE Triple<Simd> rolling_moment(const ContactColumns &c, const ContactStep &s, const Touch &t,
                                          Losses &lost) {
  const Simd effective = reduced_of(gather(c.radius, t.i), gather(c.radius, t.j));
  const Simd stiffness = gather(c.tangential_stiffness, t.row) * effective * effective;
  scatter(c.rolling_stiffness, t.row, t.count, stiffness);
  const LaneMask stiff = OfLanes::above(stiffness, Simd(0.0)); // false for a Hertz contact at its first step
  const Triple<Simd> w = gather_difference(c.angular_velocity, t.j, t.i);
  const Triple<Simd> stretch = scale(Simd(s.dt), w - scale(dot(w, t.n), t.n));
  const Simd limit = Simd(s.rolling_friction) * effective, zero = Simd(0.0);
  const auto f =
      spring_with_friction<OfLanes>(turned(c, c.rolling, t), stretch, t.pressing, stiffness, limit, limit);
  const Triple<Simd> moment = choose<OfLanes>(stiff, f.spring, gather(c.rolling, t.row));
  lost.rolling = OfLanes::choose(stiff, f.dissipated, zero);
  scatter(c.rolling, t.row, t.count, moment);
  return moment;
}

// Coulomb's spring in the turned contact plane.
template <class Effects>
PLATEN_INLINE void tangential_force(const ContactColumns &c, const ContactStep &s, Touch &t, Losses &lost) {
  const Simd zero = Simd(0.0), friction = Simd(s.friction), half_step = Simd(0.5 * s.dt);
  Simd kt = gather(c.tangential_stiffness, t.row);
  Triple<Simd> spring = turned(c, c.spring, t);
  if constexpr (!Effects::Law::constant_stiffness) {
    // A softer spring keeps its stretch, a stiffer one its force: both only lose energy. The ledger gets this
    // energy, and the work of the lost part of the mean force over the step.
    const Simd now = Simd(s.tangential_ratio) * t.kn, square = dot(spring, spring);
    const Triple<Simd> seen = spring;
    spring = choose<OfLanes>(OfLanes::above(kt, now), scale(Simd(now / kt), spring), spring);
    if constexpr (Effects::ledger) {
      const LaneMask loaded = OfLanes::above(kt, zero) & OfLanes::above(square, zero);
      // At an overlap of exactly 0 the stiffness is 0, and the spring has lost all its energy.
      const Simd left = OfLanes::choose(OfLanes::above(now, zero), dot(spring, spring) / now, zero);
      const Simd loss =
          Simd(0.5) * square / kt - Simd(0.5) * left + half_step * dot(seen - spring, t.slip_velocity);
      lost.softened = OfLanes::choose(loaded, loss, zero);
    }
    kt = now;
    scatter(c.tangential_stiffness, t.row, t.count, kt);
  }
  const auto f = spring_with_friction<OfLanes>(spring, scale(Simd(s.dt), t.slip_velocity), t.pressing, kt,
                                               friction, friction);
  lost.sliding = f.dissipated;
  scatter(c.sliding, t.row, t.count, f.slides);
  scatter(c.spring, t.row, t.count, f.spring);
  scatter(c.normal, t.row, t.count, t.n);
  t.force = t.force + f.spring;
  if (c.dashpot != nullptr) {
    // Spring and dashpot together also stay below the Coulomb limit; without normal force there is no drag.
    const Simd damping =
        Simd(2 * s.dashpot) * OfLanes::root(kt * reduced_of(gather(c.mass, t.i), gather(c.mass, t.j)));
    Triple<Simd> tangential = f.spring + scale(damping, t.slip_velocity);
    const Simd size = length<OfLanes>(tangential), limit = friction * t.pressing;
    tangential =
        choose<OfLanes>(OfLanes::above(size, limit), scale(Simd(limit / size), tangential), tangential);
    const Triple<Simd> drag = choose<OfLanes>(f.slides, no_vector<Simd>(), tangential - f.spring);
    t.force = t.force + drag;
    t.drag = t.drag + drag;
  }
}

// Geometry and normal force of a SIMD vector; returns the relative velocity (m/s).
template <class Effects>
PLATEN_INLINE Triple<Simd> approach(const ContactColumns &c, const ContactStep &s, Touch &t) {
  const Triple<Simd> d = gather_difference(c.position, t.j, t.i);
  const Simd distance = OfLanes::root(dot(d, d)), radius = gather(c.radius, t.i);
  const Simd lever = radius / (radius + gather(c.radius, t.j));
  t.n = {d.x / distance, d.y / distance, d.z / distance};
  t.ri = scale(lever, d), t.rj = t.ri - d;
  Triple<Simd> v = gather_difference(c.velocity, t.j, t.i);
  if constexpr (Effects::rotation) {
    const Triple<Simd> wi = gather(c.angular_velocity, t.i), wj = gather(c.angular_velocity, t.j);
    v = v + (cross(wj, t.rj) - cross(wi, t.ri));
    t.spun = Simd(0.5 * s.dt) * dot(wi + wj, t.n);
  } else {
    t.spun = Simd(0.0);
  }
  const Simd overlap = gather(c.rest_distance, t.row) - distance, coefficient = gather(c.coefficient, t.row);
  for (int l = 0; l < t.count; ++l)
    c.touching[t.row[l]] = 1;
  scatter(c.overlap, t.row, t.count, overlap);
  t.pressing = Effects::Law::force(coefficient, overlap);
  t.kn = Effects::Law::stiffness(coefficient, overlap);
  return v;
}

// Adds force and torques row by row, in their order.
template <class Effects>
PLATEN_INLINE void add_forces(const ContactColumns &c, const ContactBlock &b, const Touch &t,
                              const Triple<Simd> &moment) {
  Triple<Simd> on_first = cross(t.ri, t.force), on_second = cross(t.rj, t.force);
  on_second = Triple<Simd>{-on_second.x, -on_second.y, -on_second.z};
  if constexpr (Effects::rolling) on_first = on_first + moment, on_second = on_second - moment;
  const auto add = [](Vector3 &to, const Triple<Simd> &a, int l) {
    to.x += a.x.v[l], to.y += a.y.v[l], to.z += a.z.v[l];
  };
  const auto take = [](Vector3 &from, const Triple<Simd> &a, int l) {
    from.x -= a.x.v[l], from.y -= a.y.v[l], from.z -= a.z.v[l];
  };
  scatter(c.force, t.row, t.count, t.force);
  for (int l = 0; l < t.count; ++l) {
    const int ghost = b.ends[t.row[l]].second - b.own;
    add(b.force[t.i[l]], t.force, l);
    take(ghost < 0 ? b.force[t.j[l]] : b.ghost_force[ghost], t.force, l);
    if constexpr (Effects::rotation) {
      add(b.torque[t.i[l]], on_first, l);
      add(ghost < 0 ? b.torque[t.j[l]] : b.ghost_torque[ghost], on_second, l);
    }
  }
}

template <class Effects>
PLATEN_INLINE Losses add_lanes(const ContactColumns &c, const ContactBlock &b, const ContactStep &s,
                               Touch &t) {
  Losses lost;
  const Triple<Simd> v = approach<Effects>(c, s, t);
  const Simd vn = dot(v, t.n), elastic = t.pressing;
  if (c.dashpot != nullptr) { // no attraction
    const Simd damped =
        elastic -
        Simd(2 * s.dashpot) * OfLanes::root(t.kn * reduced_of(gather(c.mass, t.i), gather(c.mass, t.j))) * vn;
    t.pressing = OfLanes::choose(OfLanes::above(damped, Simd(0.0)), damped, Simd(0.0));
    t.drag = scale(Simd(elastic - t.pressing), t.n);
  }
  t.force = scale(-t.pressing, t.n);
  t.slip_velocity = v - scale(vn, t.n);
  Triple<Simd> moment = no_vector<Simd>();
  if constexpr (Effects::rolling) moment = rolling_moment<Effects>(c, s, t, lost);
  if constexpr (Effects::friction) tangential_force<Effects>(c, s, t, lost);
  if (c.dashpot != nullptr) {
    // From the mean of the forces at the two ends of the drift (leapfrog).
    if constexpr (Effects::ledger)
      lost.damping = Simd(0.5 * s.dt) * dot(t.drag + gather(c.dashpot, t.row), v);
    scatter(c.dashpot, t.row, t.count, t.drag);
  }
  add_forces<Effects>(c, b, t, moment);
  return lost;
}

// A row that touched and no longer does. Writes the energy of its springs (J) to `lost`.
template <class Effects>
PLATEN_INLINE void release(const ContactColumns &c, int k, double *lost) {
  const auto half_over = [](const Vector3 &a, double stiffness) {
    return stiffness > 0 ? 0.5 * (a.x * a.x + a.y * a.y + a.z * a.z) / stiffness : 0.0;
  };
  c.touching[k] = 0;
  c.overlap[k] = 0;
  c.force[k] = Vector3{};
  if constexpr (Effects::friction) {
    lost[0] = half_over(c.spring[k], c.tangential_stiffness[k]);
    c.spring[k] = Vector3{};
    c.sliding[k] = 0;
  }
  if (c.dashpot != nullptr) c.dashpot[k] = Vector3{};
  if constexpr (Effects::rolling) {
    lost[1] = half_over(c.rolling[k], c.rolling_stiffness[k]);
    c.rolling[k] = Vector3{};
  }
}

template <class Effects>
ContactLoss compute(const ContactColumns &c, const ContactBlock &b, const ContactStep &s, int *rows,
                    double *losses) {
  const std::size_t count = rows_at_work(c, b, rows);
  ContactLoss lost;
  Touch t;
  std::size_t at[lanes]; // index among the active rows
  t.count = 0;
  const auto finish = [&] {
    for (int l = t.count; l < lanes; ++l)
      t.row[l] = t.row[t.count - 1];
    for (int l = 0; l < lanes; ++l)
      t.i[l] = c.first[t.row[l]], t.j[l] = c.second[t.row[l]];
    const Losses of = add_lanes<Effects>(c, b, s, t);
    for (int l = 0; Effects::ledger && l < t.count; ++l) {
      double *to = losses + 3 * at[l];
      to[0] = of.rolling.v[l], to[1] = of.softened.v[l], to[2] = of.sliding.v[l];
      lost.damping += of.damping.v[l];
    }
    t.count = 0;
  };
  for (std::size_t n = 0; n < count; ++n) {
    if (is_close(c, static_cast<std::size_t>(rows[n]))) {
      at[t.count] = n;
      t.row[t.count++] = rows[n];
      if (t.count == lanes) finish();
    } else {
      losses[3 * n] = losses[3 * n + 1] = losses[3 * n + 2] = 0;
      release<Effects>(c, rows[n], losses + 3 * n);
    }
  }
  if (t.count > 0) finish();
  for (std::size_t n = 0; Effects::ledger && Effects::friction && n < 3 * count; ++n)
    lost.friction += losses[n];
  return lost;
}

// Chooses the effects one after the other, in the order of With.
template <class Law, TangentialContact tangential, bool... chosen>
ContactLoop choose_loop(const bool *effects) {
  constexpr std::size_t made = sizeof...(chosen);
  if constexpr (made < 2) {
    return effects[made] ? choose_loop<Law, tangential, chosen..., true>(effects)
                         : choose_loop<Law, tangential, chosen..., false>(effects);
  } else {
    using Effects = With<Law, tangential, chosen...>;
    if constexpr (Effects::rolling && !Effects::rotation)
      throw std::invalid_argument("rolling resistance needs particles that rotate");
    else
      return &compute<Effects>;
  }
}

ContactLoop loop_of(const ContactEffects &e) {
  const bool effects[2] = {e.rotation, e.ledger};
  return NormalContacts::with(e.normal, [&](auto of) {
    using Law = decltype(of);
    switch (e.tangential) {
      case TangentialContact::coulomb_with_rolling:
        return choose_loop<Law, TangentialContact::coulomb_with_rolling>(effects);
      case TangentialContact::coulomb:
        return choose_loop<Law, TangentialContact::coulomb>(effects);
      case TangentialContact::none:
        break;
    }
    return choose_loop<Law, TangentialContact::none>(effects);
  });
}

} // namespace

const ContactKernels PLATEN_KERNELS{rows_at_work, loop_of};

} // namespace platen::dem::kernels
