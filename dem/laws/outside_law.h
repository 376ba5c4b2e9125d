// A bond law of the user's program: elastic, written like those of the library (parallel_bond.h is one), and
// in none of its lists. The program compiles its loops from the library's source (kernels/outside_kernels.h),
// so that they are as fast as the others: a block of bonds is one call.
#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>

#include "dem/laws/bond_form.h"

namespace platen::dem {

namespace kernels { // bond_kernel.h
struct BondKernels;
} // namespace kernels

struct OutsideLaw {
  static constexpr const char *word = "outside";
  static constexpr bool has_history = false;
  using KernelsOfSets = std::array<const kernels::BondKernels *, 3>; // in the order of InstructionSet
  // Functions of the law for single bonds, outside loops. `of`: the law.
  struct Calls {
    BondResponse<double> (*turning)(const void *of, const BondGeometry<double> &, const BondMotion<double> &);
    BondResponse<double> (*without_rotation)(const void *of, const BondGeometry<double> &,
                                             const Triple<double> &);
    BondStiffness (*stiffness)(const void *of, const BondGeometry<double> &);
    bool (*bends)(const void *of);
    bool needs_rotation, centre_to_centre, over_distance, bonds_by_range;
    KernelsOfSets kernels;
  };
  struct Parameters {
    std::shared_ptr<const void> law;
    const Calls *calls = nullptr;

    static constexpr const char *name = "OutsideLaw";
    template <class Visitor, class Self>
    static void describe(Visitor &&, Self &) {} // the law has checked its parameters when it was made
  };

  bool needs_rotation = false, centre_to_centre = false, over_distance = false, bonds_by_range = false;
  Parameters parameters;

  OutsideLaw() = default;
  OutsideLaw(const Parameters &p) : parameters(p) {
    if (p.law == nullptr || p.calls == nullptr)
      throw std::invalid_argument("a bond law from outside is made by outside_law()");
    needs_rotation = p.calls->needs_rotation, centre_to_centre = p.calls->centre_to_centre;
    over_distance = p.calls->over_distance, bonds_by_range = p.calls->bonds_by_range;
  }

  BondResponse<double> operator()(const BondGeometry<double> &g, const BondMotion<double> &m) const {
    return parameters.calls->turning(parameters.law.get(), g, m);
  }
  BondResponse<double> without_rotation(const BondGeometry<double> &g, const Triple<double> &distance) const {
    return parameters.calls->without_rotation(parameters.law.get(), g, distance);
  }
  BondStiffness stiffness(const BondGeometry<double> &g) const {
    return parameters.calls->stiffness(parameters.law.get(), g);
  }
  bool bends() const { return parameters.calls->bends(parameters.law.get()); }
};

// Loops over bonds of the law for each instruction set: made by the build (platen_bond_law of CMake).
template <class Law>
OutsideLaw::KernelsOfSets outside_kernels();

// The value for ModelSettings::bond. The law is copied.
template <class Law>
OutsideLaw::Parameters outside_law(Law law) {
  static_assert(!Law::has_history, "a law from outside is elastic until it breaks");
  static const OutsideLaw::Calls calls = {
      [](const void *of, const BondGeometry<double> &g, const BondMotion<double> &m) {
        return (*static_cast<const Law *>(of))(g, m);
      },
      [](const void *of, const BondGeometry<double> &g, const Triple<double> &d) -> BondResponse<double> {
        if constexpr (Law::needs_rotation)
          throw std::logic_error("a bond that needs rotation has none");
        else
          return static_cast<const Law *>(of)->without_rotation(g, d);
      },
      [](const void *of, const BondGeometry<double> &g) {
        return static_cast<const Law *>(of)->stiffness(g);
      },
      [](const void *of) { return static_cast<const Law *>(of)->bends(); },
      Law::needs_rotation,
      Law::centre_to_centre,
      Law::over_distance,
      Law::bonds_by_range,
      outside_kernels<Law>()};
  return {std::make_shared<const Law>(std::move(law)), &calls};
}

} // namespace platen::dem
