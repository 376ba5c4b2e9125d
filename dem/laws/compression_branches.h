// Yield of a cohesive bond in compression along straight branches of falling slope, with elastic unloading.
// In stresses: e = -k_n u_n is the stress of closing without yield, q = k_n p that of the plastic closing p,
// which never decreases: q >= e - envelope(e) (Onate et al. 2015; docs/theory.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dem/laws/bond_form.h"

namespace platen::dem {

// Describes them as members of the law's parameters.
template <class Visitor, class Parameters>
void describe_compression(Visitor &&v, Parameters &p) {
  v("compression_limits", p.compression_limits, "Pa", above(0),
    "Up to three stresses, ascending, where the branches of compression begin (LCS); empty: elastic without "
    "limit.");
  v("compression_slopes", p.compression_slopes, "1", at_least(1),
    "Modulus over that of each branch, not descending (YRC); as many as limits.");
}

struct CompressionBranches {
  struct Branch {
    double limit = 0, slope = 1;     // Pa; E_0 / E of the branch, 1: no yield
    double begin = 0, per_slope = 1; // Pa, elastic stress where it begins; 1 / slope
  };
  static constexpr std::size_t most = 3;
  Branch branches[most] = {}; // if fewer are given, the last one continues
  std::size_t given = 0;

  CompressionBranches() = default;
  // Throws BadParameter with `law` as the name of the parameters.
  CompressionBranches(const char *law, const std::vector<double> &limits, const std::vector<double> &slopes);

  // Pa, stress of the first closing up to `elastic` (Pa, stress without yield).
  template <class Real>
  Real envelope(const Real &elastic) const;
  // Slope of the envelope there, 1 without yield; at a kink the slope of further closing.
  double slope(double elastic) const;
  // J/m^2 Pa/m: energy dissipated by plastic closing up to q (Pa), times the stiffness k_n.
  template <class Real>
  Real work(const Real &q) const;

private:
  double begin_of(std::size_t branch) const; // Pa, elastic stress at which a branch begins
};

inline CompressionBranches::CompressionBranches(const char *law, const std::vector<double> &limits,
                                                const std::vector<double> &slopes) {
  const std::string count = std::to_string(limits.size());
  const auto refuse = [&](const char *member, const std::string &why) {
    throw BadParameter(law, member, "", why);
  };
  if (limits.size() > most) refuse("compression_limits", "has " + count + " stresses. Allowed: up to 3.");
  if (slopes.size() != limits.size())
    refuse("compression_slopes",
           "has " + std::to_string(slopes.size()) + " numbers. Allowed: as many as limits, " + count + ".");
  if (!std::is_sorted(limits.begin(), limits.end()))
    refuse("compression_limits", "descends. Allowed: ascending stresses.");
  if (!std::is_sorted(slopes.begin(), slopes.end()))
    refuse("compression_slopes",
           "descends: compression would grow stiffer again. Allowed: ascending numbers.");
  given = limits.size();
  Branch last;
  for (std::size_t b = 0; b < most; ++b) {
    if (b < limits.size()) last = {limits[b], slopes[b], 0, 1 / slopes[b]};
    branches[b] = last;
    branches[b].begin = begin_of(b);
  }
}

// The slopes of the branches decrease, so that the lowest of their lines is the envelope.
template <class Real>
PLATEN_INLINE Real CompressionBranches::envelope(const Real &elastic) const {
  Real lowest = elastic;
  for (std::size_t b = 0; b < most; ++b) {
    if (b == given) break;
    const Branch &branch = branches[b];
    const Real line = branch.limit + (elastic - branch.begin) * branch.per_slope;
    lowest = lowest - positive_part(Real(lowest - line));
  }
  return lowest;
}

inline double CompressionBranches::begin_of(std::size_t branch) const {
  const Branch *b = branches;
  double begin = b[0].limit;
  for (std::size_t k = 1; k <= branch; ++k)
    begin += (b[k].limit - b[k - 1].limit) * b[k - 1].slope;
  return begin;
}

inline double CompressionBranches::slope(double elastic) const {
  double slope = 1;
  for (std::size_t b = 0; b < most; ++b)
    if (elastic >= begin_of(b) && branches[b].slope > slope) slope = branches[b].slope;
  return 1 / slope;
}

// Along a branch of slope Y from e_b the yield stress is (LCS Y + q - e_b)/(Y - 1); a branch of slope 1 adds
// no closing. Each branch is integrated from the end of the last one to q or to its own end.
template <class Real>
PLATEN_INLINE Real CompressionBranches::work(const Real &q) const {
  Real work = q * 0.0;
  double from = 0;
  for (std::size_t b = 0; b < most; ++b) {
    const Branch &branch = branches[b];
    if (!(branch.slope > 1)) continue;
    Real to = q;
    double end = from;
    if (b + 1 < most) {
      end = begin_of(b + 1) - branches[b + 1].limit;
      to = where_positive(Real(end - q), q, Real(end + work * 0.0));
    }
    const Real passed = positive_part(Real(to - from));
    const double hardening = 1 / (branch.slope - 1);
    const double begin = (branch.limit * branch.slope + from - begin_of(b)) * hardening; // Pa
    work = work + (begin + (0.5 * hardening) * passed) * passed;
    from = end;
  }
  return work;
}

} // namespace platen::dem
