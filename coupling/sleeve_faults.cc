#include "coupling/sleeve_faults.h"

#include <cmath>
#include <string>

#include "base/pi.h"
#include "base/shortest_text.h"

namespace platen::coupling {
namespace {

// Of a tube: the ends that it leaves free together, of the height; its gap, of the radius.
constexpr double most_clearance = 0.5, most_gap = 0.1;

// Of metal: beyond it the series of its logarithmic strain lose digits.
constexpr double largest_elastic_strain = 0.1;

// Of structural steel, over its yield strength: the yield point lies well before the end of the plateau.
constexpr double least_modulus_of_steel = 100;

class SleeveRules {
public:
  SleeveRules(const PlatenTestSettings &settings, const dem::Shape *shape, bool servo)
      : s_(settings), p_(settings.platens), l_(settings.loading), shape_(shape), servo_(servo) {}

  std::vector<Fault> all() {
    if (l_.tube)
      tube(*l_.tube);
    else
      sleeve(*l_.sleeve(), "loading.cell");
    return std::move(found_);
  }

private:
  void refuse_if(bool broken, const std::string &member, const std::string &reason) {
    if (broken) found_.push_back({member, reason});
  }

  void sleeve(const SleeveSettings &sleeve, const std::string &of) {
    refuse_if(shape_ != nullptr && shape_->kind != dem::ShapeKind::cylinder, of,
              "is a sleeve, which goes around a cylinder. Allowed: none, particles.");
    refuse_if(s_.model.scheme != dem::Scheme::velocity_verlet, "ModelSettings.scheme",
              "does not go with a sleeve. Allowed: velocity verlet.");
    refuse_if(sleeve.mass_scaling > 0 && sleeve.mass_scaling < 1, "sleeve.mass_scaling",
              "makes the sleeve lighter. Allowed: 0, or 1 and more.");
    refuse_if(sleeve.elements_around > 0 && sleeve.elements_around < 8, "sleeve.elements_around",
              "is too few for a tube. Allowed: 0, or 8 and more.");
    if (!(sleeve.contact.bond.strength > 0)) return;
    refuse_if(sleeve.gap > 0, "sleeve.gap",
              "leaves nothing that `sleeve.bond_strength` could hold. Allowed: 0, or no bond.");
    refuse_if(sleeve.seat_layer == 0, "sleeve.seat_layer",
              "leaves no sphere flush with the tube, and `sleeve.bond_strength` holds these. Allowed: above "
              "0, or no bond.");
  }

  void tube(const SleeveSettings &tube) {
    sleeve(tube, "loading.tube");
    refuse_if(l_.cell.has_value(), "loading.cell",
              "does not go with a tube, which stands in no cell. Allowed: none.");
    refuse_if(l_.wall, "loading.wall", "does not go with a tube. Allowed: none.");
    refuse_if(l_.tension, "loading.tension", "does not go with a tube. Allowed: compression.");
    if (shape_ != nullptr && shape_->kind == dem::ShapeKind::cylinder) {
      refuse_if(
          tube.thickness > shape_->radius, "sleeve.thickness",
          "is more than the radius of the specimen, " + text_of(shape_->radius) + " m. Allowed: up to that.");
      refuse_if(2 * tube.clearance > most_clearance * shape_->height, "sleeve.clearance",
                "leaves less than half of the specimen's height for the tube. Allowed: up to " +
                    text_of(0.5 * most_clearance * shape_->height) + " m.");
      refuse_if(
          tube.gap > most_gap * shape_->radius, "sleeve.gap",
          "is more than a tenth of the radius. Allowed: up to " + text_of(most_gap * shape_->radius) + " m.");
    }
    if (tube.recess > 0) recess(tube.recess);
    if (tube.metal) {
      const std::vector<Fault> more =
          metal_faults(*tube.metal, "sleeve.metal.", tube.young_modulus, "sleeve.young_modulus");
      found_.insert(found_.end(), more.begin(), more.end());
    }
    if (tube.wrap) wrap(tube, *tube.wrap);
  }

  void wrap(const SleeveSettings &tube, const WrapSettings &wrap) {
    refuse_if(tube.metal.has_value(), "sleeve.metal", "does not go with a wrap. Allowed: one of both.");
    refuse_if(std::isnan(wrap.rupture_strain), "sleeve.wrap.rupture_strain", "has to be given for a wrap.");
    refuse_if(tube.young_modulus < wrap.resin_modulus, "sleeve.young_modulus",
              "of a wrap is below that of its resin, " + text_of(wrap.resin_modulus) +
                  " Pa. Allowed: that or more.");
    refuse_if(
        wrap.axial_modulus > 0 && wrap.axial_modulus < wrap.resin_modulus, "sleeve.wrap.axial_modulus",
        "is below that of the resin, " + text_of(wrap.resin_modulus) + " Pa. Allowed: 0, or that or more.");
    if (shape_ == nullptr || shape_->kind != dem::ShapeKind::cylinder) return;
    const double hoop = 2 * pi * shape_->radius;
    refuse_if(wrap.overlap > hoop, "sleeve.wrap.overlap",
              "is more than once around, which is a layer. Allowed: up to " + text_of(hoop) + " m.");
  }

  // The specimen ends short of a platen.
  void recess(double recess) {
    refuse_if(shape_ != nullptr && 2 * recess > most_clearance * shape_->height, "sleeve.recess",
              "leaves more than a third of the tube empty. Allowed: up to " +
                  text_of(0.5 * most_clearance * (shape_ != nullptr ? shape_->height : 0)) + " m.");
    refuse_if(
        servo_, "sleeve.recess",
        "leaves a platen that is asked for a stress nothing to press. Allowed: 0, or no `loading.servo` "
        "and no stage that asks the top platen for a stress.");
    refuse_if(p_.glued, "platens.glued",
              "holds ends that `sleeve.recess` keeps off the platens. Allowed: contact.");
    refuse_if(
        !l_.unload_at.empty(), "loading.unload_at",
        "waits for the stress of a specimen that `sleeve.recess` keeps off the platens. Allowed: none.");
  }

  const PlatenTestSettings &s_;
  const PlatenSettings &p_;
  const LoadingSettings &l_;
  const dem::Shape *shape_;
  bool servo_;
  std::vector<Fault> found_;
};

} // namespace

std::vector<Fault> metal_faults(const MetalSettings &metal, const std::string &of, double young_modulus,
                                const std::string &modulus_of) {
  std::vector<Fault> found;
  const auto refuse_if = [&](bool broken, const std::string &member, const std::string &reason) {
    if (broken) found.push_back({member, reason});
  };
  refuse_if(std::isnan(metal.yield_strength), of + "yield_strength",
            "has to be given for metal that yields. Allowed: above 0 Pa.");
  refuse_if(metal.yield_strength > largest_elastic_strain * young_modulus, of + "yield_strength",
            "is more than a tenth of Young's modulus: the law is of metals, whose elastic strains are small. "
            "Allowed: up to " +
                text_of(largest_elastic_strain * young_modulus) + " Pa.");
  refuse_if(metal.ultimate_strength < metal.yield_strength, of + "ultimate_strength",
            "is below the yield strength. Allowed: " + text_of(metal.yield_strength) + " Pa or more.");
  refuse_if(!std::isnan(metal.ultimate_strength) && !metal.points.empty(), of + "ultimate_strength",
            "does not go with points of hardening. Allowed: one of both.");
  refuse_if(metal.ultimate_strength > metal.yield_strength &&
                young_modulus < least_modulus_of_steel * metal.yield_strength,
            modulus_of,
            "is too low beside the yield strength for the lines of structural steel: " +
                text_of(metal.yield_strength) +
                " Pa. Allowed: " + text_of(least_modulus_of_steel * metal.yield_strength) +
                " Pa or more, or no ultimate strength.");
  refuse_if((metal.saturation > 0) != (metal.saturation_rate > 0), of + "saturation_rate",
            "and the saturation go together. Allowed: both above 0, or none.");
  return found;
}

std::vector<Fault> sleeve_faults(const PlatenTestSettings &settings, const dem::Shape *shape, bool servo) {
  return SleeveRules(settings, shape, servo).all();
}

} // namespace platen::coupling
