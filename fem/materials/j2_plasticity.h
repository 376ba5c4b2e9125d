// Metal plasticity after von Mises (J2) with isotropic hardening, as a law between deviators of elastic
// logarithmic strain (Hencky) and Kirchhoff stress: s = 2 mu e. Yielding leaves the volume as it is, and with
// logarithmic strains the return to the yield surface at finite strain is that of small strain, along the
// trial strain itself (Weber, Anand: Comput. Methods Appl. Mech. Eng. 79, 1990; Simo: the same, 99, 1992):
//   q = sqrt(3/2) |s| <= k(a),   q_trial - 3 mu da = k(a + da),   e = (1 - 3 mu da / q_trial) e_trial
// a: equivalent plastic strain, k: flow stress. A body at small strain uses it as it stands, with e_trial the
// deviator of total less plastic strain.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "base/portable.h"
#include "fem/materials/neo_hookean.h"

namespace platen::fem {

// Flow stress over equivalent plastic strain: straight lines between points, constant after the last one, and
// a part that saturates (Voce: J. Inst. Metals 74, 1948). Either may be left out.
//   k(a) = line(a) + saturation (1 - exp(-rate a))
struct Hardening {
  struct Point {
    double strain = 0; // 1, plastic
    double stress = 0; // Pa
  };
  static constexpr std::size_t most_points = 32;

  std::array<Point, most_points> points{}; // the first at strain 0: the yield strength
  std::size_t count = 0;
  double saturation = 0; // Pa
  double rate = 0;       // 1

  // Throws std::invalid_argument unless the first point is at 0, strains ascend, stresses are positive and do
  // not fall, and saturation and rate are not negative.
  void require_valid() const {
    const auto refuse = [](const char *what) { throw std::invalid_argument(what); };
    if (count < 1 || count > most_points) refuse("hardening: 1 to 32 points");
    if (points[0].strain != 0 || !(points[0].stress > 0) || std::isinf(points[0].stress))
      refuse("hardening: the first point is the yield strength, at a plastic strain of 0");
    for (std::size_t k = 1; k < count; ++k)
      if (!(points[k].strain > points[k - 1].strain) || !(points[k].stress >= points[k - 1].stress) ||
          std::isinf(points[k].strain) || std::isinf(points[k].stress))
        refuse("hardening: strains have to ascend, and stresses must not fall");
    if (!(saturation >= 0) || !(rate >= 0) || std::isinf(saturation) || std::isinf(rate))
      refuse("hardening: saturation and rate must not be negative");
  }

  double yield_strength() const { return points[0].stress; }
  struct Flow {
    double stress = 0; // Pa
    double slope = 0;  // Pa, by plastic strain
    double work = 0;   // J/m^3, integral of the stress from 0
  };
  // a >= 0.
  Flow at(double a) const {
    Flow flow;
    std::size_t k = 0;
    for (; k + 1 < count && points[k + 1].strain <= a; ++k)
      flow.work +=
          0.5 * (points[k].stress + points[k + 1].stress) * (points[k + 1].strain - points[k].strain);
    if (k + 1 < count)
      flow.slope = (points[k + 1].stress - points[k].stress) / (points[k + 1].strain - points[k].strain);
    const double beyond = a - points[k].strain;
    flow.stress = points[k].stress + flow.slope * beyond;
    flow.work += 0.5 * (points[k].stress + flow.stress) * beyond;
    if (saturation > 0 && rate > 0) {
      const double rest = portable::exp(-rate * a);
      flow.stress += saturation * (1 - rest);
      flow.slope += saturation * rate * rest;
      flow.work += saturation * (a - (1 - rest) / rate);
    }
    return flow;
  }
};

struct J2Plasticity {
  double shear_modulus; // Pa
  Hardening hardening;

  struct Return {
    double share = 1;          // of the trial strain that stays elastic
    double plastic_strain = 0; // 1, equivalent, after the step
  };

  // `trial`: sqrt(2/3) |e_trial|, the equivalent of the trial strain: 3 mu times it is the trial stress.
  // `before`: the plastic strain before the step.
  Return operator()(double trial, double before) const {
    const double stiff = 3 * shear_modulus;
    const double q = stiff * trial;
    if (!(q > hardening.yield_strength())) return {1, before};
    Hardening::Flow flow = hardening.at(before);
    if (!(q > flow.stress)) return {1, before};
    // Newton's method within bounds: the excess falls at least as fast as the elastic line, and never rises.
    double low = 0, high = (q - flow.stress) / stiff, more = 0;
    for (int k = 0; k < most_iterations; ++k) {
      const double excess = q - stiff * more - flow.stress;
      if (excess >= 0) low = more;
      if (excess <= 0) high = more;
      if (std::abs(excess) <= round_off * q) break;
      const double next = more + excess / (stiff + flow.slope), last = more;
      more = next >= low && next <= high ? next : 0.5 * (low + high);
      if (more == last) break;
      flow = hardening.at(before + more);
    }
    return {1 - stiff * more / q, before + more};
  }

  // Derivative of the deviator of stress by that of the trial strain in this step, for the direction n of the
  // trial strain: ds = 2 mu (share (de - n n:de) + along n n:de), Pa.
  struct Tangent {
    double across = 0, along = 0; // 2 mu times the shares
  };
  Tangent tangent(double trial, double before) const {
    const Return after = (*this)(trial, before);
    const double mu = shear_modulus;
    if (after.plastic_strain == before) return {2 * mu, 2 * mu};
    const double slope = hardening.at(after.plastic_strain).slope;
    return {2 * mu * after.share, 2 * mu * slope / (3 * mu + slope)};
  }

  static constexpr int most_iterations = 60;
  static constexpr double round_off = 1e-14; // of the trial stress
};

} // namespace platen::fem
