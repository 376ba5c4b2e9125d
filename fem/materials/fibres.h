// Fibres in two directions of a laminate, as springs that its resin holds together: linear in the nominal
// stress and strain in which coupons are reported,
//   s = E (l - 1),   W = E/2 (l - 1)^2,   l = |F d|,
// with E the modulus of the fibres alone, referred to the whole section (that of the laminate less that of
// its resin), d their direction without load. Fibres of the first direction rupture at a strain and take the
// element with them: what is left of the resin holds the torn element's shape, not the wrap together.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "base/vector3.h"

namespace platen::fem {

// Those of an element.
struct FibreCell {
  std::array<Vector3, 2> direction{}; // unit vectors
  double share = 1;                   // of the laminate that is there: more where layers overlap, 0 torn
};

struct Fibres {
  std::array<double, 2> modulus{};                  // Pa
  double rupture_strain = 0;                        // 1, nominal, of the first direction, mean of an element
  std::function<FibreCell(const Vector3 &)> layout; // at the middle of an element (m); called at set-up

  static constexpr double rest_of_torn = 1e-3; // of the resin's stiffness

  // Throws std::invalid_argument.
  void require_valid() const {
    const auto refuse = [](const char *what) { throw std::invalid_argument(what); };
    for (const double e : modulus)
      if (!(e >= 0) || std::isinf(e)) refuse("fibres: moduli must not be negative");
    if (!(rupture_strain > 0)) refuse("fibres: the rupture strain must be positive");
    if (!layout) refuse("fibres: their directions are needed");
  }
};

} // namespace platen::fem
