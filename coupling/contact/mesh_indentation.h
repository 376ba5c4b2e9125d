// The spring of a contact in series with the mesh below it, for one contact or for a SIMD vector of them: one
// source, so that both give the same bits.
#pragma once

#include "dem/laws/lanes.h"

namespace platen::coupling {

// A body that is solved only now and then responds to a force with k_n c of it, and to that again: below 1
// this decays. The spring of a contact is therefore made stiffer only up to this k_n c; where the indentation
// alone reaches this limit, nothing is taken out.
constexpr double most_answer = 0.85;
constexpr double most_indentation = most_answer / (1 + most_answer); // k c up to which all of it is taken out

// w^T C w, the rows of C one after the other.
template <class Real>
PLATEN_INLINE Real indentation_of(const dem::Rotation<Real> &w, const dem::Rotation<Real> (&c)[4]) {
  const auto row = [&w](const dem::Rotation<Real> &of) {
    return Real((w.w * of.w + w.x * of.x) + (w.y * of.y + w.z * of.z));
  };
  return w.w * row(c[0]) + w.x * row(c[1]) + w.y * row(c[2]) + w.z * row(c[3]);
}

// N/m, of the spring that gives this stiffness in series with an indentation (m/N).
template <class How, class Real>
PLATEN_INLINE Real in_series_with_indentation(const Real &stiffness, const Real &indentation) {
  const Real one = Real(1.0), most = Real(most_indentation), fraction = stiffness * indentation;
  const Real taken_out = How::choose(How::above(fraction, most), most, fraction);
  const Real grown = one / (one - taken_out), answer = Real(most_answer) / fraction;
  const Real limit = How::choose(How::above(answer, one), answer, one);
  return stiffness * How::choose(How::above(grown, limit), limit, grown);
}

} // namespace platen::coupling
