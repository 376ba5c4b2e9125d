// The law that holds the grains together, and what every law is given: an entry of section Bond sets the
// member of its name in all laws that have it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene_calibrated.h"
#include "dem/heterogeneity.h"
#include "dem/laws/bond_law.h"

namespace platen::apps {

// Bonds that are calibrated for spheres of one size, for spheres of another: the modulus, and strengths and
// limits of compression, times powers of the mean radius over that of the calibration. Where the width of the
// specimen of the calibration is given, both radii are shares of the least width: an exactly similar specimen
// has the same stresses whatever its size, so that the number of spheres across decides, not their metres.
struct SizeCorrection {
  double reference = 0;       // m, mean radius that they are calibrated for; 0: taken as they are
  double reference_width = 0; // m, least width of the specimen that they are calibrated for; 0: not given
  double modulus_exponent = 0, strength_exponent = 0;
  bool corrects() const { return modulus_exponent != 0 || strength_exponent != 0; }
  bool by_width() const { return reference_width > 0; }
  // Of the mean radius over that of the calibration; NaN where what it takes is not given.
  double share(const SpecimenSection &of) const {
    return of.sphere_radius / reference * (by_width() ? reference_width / of.width() : 1);
  }
  // What share() may be: a little beyond the sizes of bench/results/sizes.md (.51 to 1.26).
  static constexpr double least_share = 0.5, most_share = 1.5;

  static constexpr const char *name = "SizeCorrection";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p) {
    v("calibrated_radius", p.reference, "m", at_least(0),
      "Mean radius of the spheres that the bonds are calibrated for; 0: bonds are as they are given for "
      "spheres of any size.");
    v("calibrated_width", p.reference_width, "m", at_least(0),
      "Least width of the specimen that the bonds are calibrated in. Where it is given, Calibrated radius "
      "over "
      "it counts, and Specimen/Sphere radius over the specimen's least width: spheres across decide. 0: "
      "radii "
      "are compared as they are.");
    v("modulus_exponent", p.modulus_exponent, "1", between(-1, 1),
      "Bond/Modulus is multiplied by (Specimen/Sphere radius over Calibrated radius) to this power; both "
      "over their widths where Calibrated width is given.");
    v("strength_exponent", p.strength_exponent, "1", between(-1, 1),
      "The same of both strengths and of Compression limits.");
  }
};

class Bond {
public:
  static constexpr int none = -1;
  int law = 0; // Effects/Bond: the place in dem::BondLaws, or none
  dem::BondLaws::AllParameters laws;
  bool scattered = false; // Strength scatter
  dem::StrengthScatter scatter;
  SizeCorrection size;
  CalibratedFor calibrated;

  bool bonded() const { return law != none; }
  template <class Law>
  bool is() const {
    return law == static_cast<int>(dem::BondLaws::place<Law>());
  }
  const char *word() const { return bonded() ? dem::BondLaws::words[static_cast<std::size_t>(law)] : "none"; }
  std::optional<dem::BondParameters> parameters() const;
  bool remembers() const;
  bool bonds_by_range() const;
  bool has(const std::string &member) const; // the law chosen
  // By the name of a member: of the first law that has it; in all of them.
  double number(const std::string &member) const;
  void set(const std::string &member, double value);
  // Of the law chosen, empty where it has none; in all that have it.
  std::vector<double> list(const std::string &member) const;
  void set(const std::string &member, const std::vector<double> &values);
  // With what stands for spheres of this share of the calibrated size (SizeCorrection::share).
  Bond for_size(double share) const;
};

} // namespace platen::apps
