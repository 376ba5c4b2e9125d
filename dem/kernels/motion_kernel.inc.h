// Body of the motion kernels; the including file sets PLATEN_LANES and PLATEN_KERNEL. It is compiled without
// contraction, and sums are kept by row number modulo `slots`, so that every instruction set gives the same
// bits.
#include "dem/kernels/motion_kernel.h"
#include "dem/kernels/simd.inc.h"

namespace platen::dem::kernels {
namespace {

constexpr std::size_t slots = 8;

// Access to one row, for rows that do not fill a SIMD vector.
inline Triple<double> load_one(const Vector3 *from) {
  return {from->x, from->y, from->z};
}
inline void store(Vector3 *to, const Triple<double> &t) {
  *to = {t.x, t.y, t.z};
}
inline void store(Quaternion *to, const Rotation<double> &q) {
  *to = {q.w, q.x, q.y, q.z};
}
template <class Real>
struct Rows;
template <>
struct Rows<Simd> {
  static Simd scalar(const double *from) { return load(from); }
  static Triple<Simd> vector(const Vector3 *from) { return load(from); }
  static Rotation<Simd> rotation(const Quaternion *from) { return load(from); }
};
template <>
struct Rows<double> {
  static double scalar(const double *from) { return *from; }
  static Triple<double> vector(const Vector3 *from) { return load_one(from); }
  static Rotation<double> rotation(const Quaternion *from) { return {from->w, from->x, from->y, from->z}; }
};

template <class Real>
struct PartialSums {
  Real damping_work{}, weight_work{}, unbalanced{}, kinetic_energy{}, speed_squares{}, fastest_square{};
};

// Cundall's local damping of one component.
template <class Real>
inline Real damped(const Real &force, const Real &velocity, double alpha) {
  return force - with_sign(Real(alpha * magnitude(force)), velocity);
}

// Local damping of the load as a vector, along the velocity; no damping at zero velocity.
template <class Real>
inline Triple<Real> damped_along(const Triple<Real> &load, const Triple<Real> &v, double alpha) {
  const Real speed = root(dot(v, v)), zero = speed * 0.0;
  const Real factor = alpha * root(dot(load, load)) / where_positive(speed, speed, Real(zero + 1.0));
  return load - scale(factor, v);
}

// A load after local damping, in the form of the step.
template <class Real>
inline Triple<Real> damped(const Triple<Real> &load, const Triple<Real> &v, const MotionStep &step) {
  const double alpha = step.local_damping;
  if (step.damping == LocalDamping::none) return load;
  if (step.damping == LocalDamping::vector) return damped_along(load, v, alpha);
  return {damped(load.x, v.x, alpha), damped(load.y, v.y, alpha), damped(load.z, v.z, alpha)};
}

// Rotates q by dt w; Cayley's form needs no sine and is exact to (w dt)^3 / 12, the order of the scheme.
template <class Real>
inline Rotation<Real> turned_by(const Rotation<Real> &q, const Triple<Real> &w, double dt) {
  const Triple<Real> h = scale(Real(0.5 * dt), w);
  const Rotation<Real> p{q.w - h.x * q.x - h.y * q.y - h.z * q.z, q.x + h.x * q.w + h.y * q.z - h.z * q.y,
                         q.y - h.x * q.z + h.y * q.w + h.z * q.x, q.z + h.x * q.y - h.y * q.x + h.z * q.w};
  const Real s = 1.0 / root(p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z);
  return {s * p.w, s * p.x, s * p.y, s * p.z};
}

// Damping and second half kick of one kind of velocity, linear or angular, by one kind of load. `kept`:
// address of drift velocity minus half-step velocity, only with a dissipative scheme.
template <class Real, bool dissipative, Halves halves>
inline void end_kick(Triple<Real> &v, Triple<Real> &load, const Real &mass, const Real &mobility,
                     const MotionStep &step, PartialSums<Real> &sums, const Vector3 *kept) {
  const Triple<Real> undamped = load;
  [[maybe_unused]] Triple<Real> excess{};
  if constexpr (dissipative) excess = Rows<Real>::vector(kept);
  load = damped(load, v, step);
  if constexpr (dissipative) v = v - excess;
  v = v + scale(Real(0.5 * step.finished * mobility), load);
  if (!step.energy_sums) return;
  // The work lost in the step, at the full-step velocity, as in the leapfrog scheme.
  Triple<Real> mean = v;
  if constexpr (dissipative) {
    // Work of the mean of the loads at both ends of the drift over its excess displacement.
    const Real before = (1 / step.excess) * mass * dot(excess, excess);
    sums.damping_work = sums.damping_work + 0.5 * (before + step.finished * dot(load, excess));
    // The mean of the drifts on both sides, which the excess makes different from the full-step velocity.
    const Triple<Real> next = scale(Real(step.excess * step.finished * mobility), load);
    mean = v + scale(Real(0.5), excess + next);
  }
  if (step.damping != LocalDamping::none)
    sums.damping_work = sums.damping_work + step.finished * dot(undamped - load, mean);
  if constexpr (halves == Halves::end) sums.kinetic_energy = sums.kinetic_energy + 0.5 * mass * dot(v, v);
}

// First half kick; with a dissipative scheme the drift that follows is faster than the half-step velocity.
template <class Real, bool dissipative>
inline void begin_kick(Triple<Real> &v, const Triple<Real> &load, const Real &mobility,
                       const MotionStep &step, [[maybe_unused]] Vector3 *kept) {
  v = v + scale(Real(0.5 * step.next * mobility), load);
  if constexpr (dissipative) {
    const Triple<Real> excess = scale(Real(step.excess * step.next * mobility), load);
    v = v + excess;
    store(kept, excess);
  }
}

template <class Real, bool rotation, bool dissipative, Halves halves>
inline void move(const MotionColumns &c, const MotionStep &step, std::size_t i, PartialSums<Real> &sums) {
  using R = Rows<Real>;
  Triple<Real> v = R::vector(c.velocity + i), force = R::vector(c.force + i);
  const Real mass = R::scalar(c.mass + i), mobility = 1.0 / mass;
  [[maybe_unused]] Vector3 *const excess = dissipative ? c.excess_velocity + i : nullptr;
  if constexpr (halves == Halves::end) sums.unbalanced = sums.unbalanced + root(dot(force, force));
  if constexpr (halves != Halves::begin) {
    [[maybe_unused]] const Triple<Real> drift = v;
    end_kick<Real, dissipative, halves>(v, force, mass, mobility, step, sums, excess);
    if (step.weight_sum) {
      const Triple<Real> g{Real(step.gravity.x), Real(step.gravity.y), Real(step.gravity.z)};
      sums.weight_work = sums.weight_work + step.finished * mass * dot(g, dissipative ? drift : v);
    }
  }
  if constexpr (halves == Halves::end) {
    store(c.force + i, force);
  } else {
    begin_kick<Real, dissipative>(v, force, mobility, step, excess);
    store(c.position + i, R::vector(c.position + i) + scale(Real(step.next), v));
    const Real square = dot(v, v);
    sums.speed_squares = sums.speed_squares + square;
    sums.fastest_square = larger(square, sums.fastest_square);
  }
  store(c.velocity + i, v);
  if constexpr (rotation) {
    Triple<Real> w = R::vector(c.angular_velocity + i), torque = R::vector(c.torque + i);
    const Real inertia = R::scalar(c.inertia + i), turn_mobility = 1.0 / inertia;
    [[maybe_unused]] Vector3 *const excess_spin = dissipative ? c.excess_spin + i : nullptr;
    if constexpr (halves != Halves::begin)
      end_kick<Real, dissipative, halves>(w, torque, inertia, turn_mobility, step, sums, excess_spin);
    if constexpr (halves == Halves::end) {
      store(c.torque + i, torque);
    } else {
      begin_kick<Real, dissipative>(w, torque, turn_mobility, step, excess_spin);
      store(c.orientation + i, turned_by(R::rotation(c.orientation + i), w, step.next));
    }
    store(c.angular_velocity + i, w);
  }
}

template <bool rotation, bool dissipative, Halves halves>
MotionSums move_block(MotionColumns c, MotionStep step, std::size_t first, std::size_t last) {
  constexpr std::size_t wide_rows = slots / lanes;
  PartialSums<Simd> wide[wide_rows];
  std::size_t i = first;
  for (; i + slots <= last; i += slots)
    for (std::size_t p = 0; p < wide_rows; ++p)
      move<Simd, rotation, dissipative, halves>(c, step, i + p * lanes, wide[p]);
  PartialSums<double> slot[slots];
  for (std::size_t s = 0; s < slots; ++s) {
    const PartialSums<Simd> &w = wide[s / lanes];
    const std::size_t l = s % lanes;
    slot[s] = {w.damping_work.v[l],   w.weight_work.v[l],   w.unbalanced.v[l],
               w.kinetic_energy.v[l], w.speed_squares.v[l], w.fastest_square.v[l]};
  }
  for (std::size_t s = 0; i < last; ++i, ++s)
    move<double, rotation, dissipative, halves>(c, step, i, slot[s]);
  MotionSums sums;
  for (const PartialSums<double> &b : slot) {
    sums.damping_work += b.damping_work;
    sums.weight_work += b.weight_work;
    sums.unbalanced += b.unbalanced;
    sums.kinetic_energy += b.kinetic_energy;
    sums.speed_squares += b.speed_squares;
    sums.fastest_square = larger(b.fastest_square, sums.fastest_square);
  }
  return sums;
}

template <bool rotation, bool dissipative>
MotionKernel kernel_for(Halves halves) {
  if (halves == Halves::end) return move_block<rotation, dissipative, Halves::end>;
  if (halves == Halves::begin) return move_block<rotation, dissipative, Halves::begin>;
  return move_block<rotation, dissipative, Halves::end_and_begin>;
}

} // namespace

MotionKernel PLATEN_KERNEL(Halves halves, const MotionEffects &e) {
  if (e.rotation) return e.dissipative ? kernel_for<true, true>(halves) : kernel_for<true, false>(halves);
  return e.dissipative ? kernel_for<false, true>(halves) : kernel_for<false, false>(halves);
}

} // namespace platen::dem::kernels
