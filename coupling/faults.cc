#include "coupling/faults.h"

#include <algorithm>
#include <cmath>

#include "base/shortest_text.h"
#include "coupling/boundary.h"
#include "coupling/platens_of_test.h"
#include "coupling/sleeve_faults.h"
#include "dem/laws/bond_law.h"

namespace platen::coupling {
namespace {

using By = dem::Weakening::By;

class Rules {
public:
  Rules(const PlatenTestSettings &settings, const dem::Shape *shape)
      : s_(settings), p_(settings.platens), l_(settings.loading), shape_(shape) {}

  std::vector<Fault> all() {
    for (const Side side : {Side::top, Side::bottom, Side::left, Side::right, Side::front, Side::back})
      if (p_.side(side) != nullptr) friction(side, *p_.side(side));
    driving();
    if (p_.elastic) elastic();
    if (p_.machine.yields()) machine();
    if (is_disc())
      no_seat();
    else if (p_.spherical_seat || p_.seat_friction_arm != 0)
      seat();
    if (p_.eccentricity != 0 || p_.tilt != 0) oblique();
    if (s_.ends > Ends::ground) faces();
    if (presses_by_hertz(s_)) hertz();
    if (l_.start_strain > 0) start();
    if (p_.span > 0) bending();
    if (shape_ != nullptr && shape_->notch.is_there()) notch(*shape_);
    if (!l_.unload_at.empty()) cycles();
    lateral();
    if (l_.cell) cell();
    if (l_.sleeve() != nullptr) take(sleeve_faults(s_, shape_, has_servo()));
    if (p_.left || p_.right || p_.front || p_.back) sides();
    if (!l_.stages.empty()) stages();
    return std::move(found_);
  }

private:
  void refuse(const std::string &member, const std::string &reason) { found_.push_back({member, reason}); }
  void take(const std::vector<Fault> &more) { found_.insert(found_.end(), more.begin(), more.end()); }
  void refuse_if(bool broken, const std::string &member, const std::string &reason) {
    if (broken) refuse(member, reason);
  }

  void friction(Side which, const PlatenSide &side) {
    const std::string of = std::string("platens.") + name_of(which) + ".";
    const double rest = side.friction_static, moving = side.dynamic();
    refuse_if(moving > rest, of + "friction_dynamic",
              "is above the static friction, " + text_of(rest) + ", of the " + name_of(which) +
                  " platen. Allowed: 0 ... " + text_of(rest) + ".");
    const dem::Weakening &weakening = side.weakening;
    if (weakening.by == By::nothing) return;
    const bool by_slip = weakening.by == By::slip;
    refuse_if(std::isnan(by_slip ? weakening.slip_length : weakening.slip_velocity), of + "friction_law",
              "needs `" + of + (by_slip ? "slip_length` > 0 m." : "slip_velocity` > 0 m/s."));
    refuse_if(moving == rest, of + "friction_law",
              "has nothing to fall to. Allowed: a `" + of + "friction_dynamic` below the static one, " +
                  text_of(rest) + ".");
  }

  void driving() {
    refuse_if(l_.tension && !p_.glued, "loading.tension",
              "needs `platens.glued` = glued: a platen in contact cannot pull.");
    refuse_if(l_.servo && l_.top_stress == 0, "loading.servo", "needs `loading.top_stress` > 0.");
    refuse_if(l_.servo && l_.tension, "loading.servo", "presses, but the test pulls. Allowed: motion.");
    refuse_if(l_.rate_multiplier > 1 && !bonded(), "loading.rate_multiplier",
              "needs bonds: they tell when the specimen fails. Allowed: 1.");
    refuse_if(l_.servo_gain > 0 && l_.servo_gain < 0.1, "loading.servo_gain",
              "is too slow to hold anything. Allowed: 0, or 0.1 ... 10.");
    if (!std::isnan(l_.rate) || !(l_.wave_transits > 0) || alone()) return;
    // A speed for compression is too high for what breaks at a tenth of the strain, or oscillates.
    refuse_if(l_.tension || p_.span > 0, "loading.wave_transits",
              "sets no speed but of compression and uniaxial strain. Allowed: a `loading.rate`.");
    refuse_if(!bonded(), "loading.wave_transits",
              "needs bonds: they carry the wave. Allowed: a `loading.rate`.");
  }

  void elastic() {
    refuse_if(!verlet(), "platens.elastic",
              "needs `ModelSettings.scheme` = velocity verlet. Allowed: rigid.");
    refuse_if(l_.start_strain > 0, "platens.elastic",
              "needs `loading.start_strain` = 0: the static solve is between rigid ends. Allowed: rigid.");
    refuse_if(p_.elastic->pad_thickness > 0 && !p_.elastic->layers.empty(), "platens.elastic.layers",
              "is another way to say `platens.elastic.pad_thickness`. Allowed: one of them.");
    const bool has_plate = std::any_of(all_sides.begin(), all_sides.end(), [&](Side side) {
      return p_.side(side) != nullptr && p_.side(side)->grid == nullptr;
    });
    refuse_if(
        has_plate && p_.thickness > 0 && p_.elastic->pad_thickness >= p_.thickness,
        "platens.elastic.pad_thickness",
        "leaves nothing of the platen. Allowed: 0 ... " + text_of(p_.thickness) + " m, `platens.thickness`.");
    if (!p_.elastic->metal) return;
    refuse_if(p_.elastic->motion == fem::ElasticMotion::quasi_static, "platens.elastic.motion",
              "is of platens that stay elastic: what yields goes its path in steps. Allowed: explicit, or "
              "`platens.elastic.metal` = elastic.");
    refuse_if(
        std::none_of(all_sides.begin(), all_sides.end(), [&](Side side) { return has_own_material(side); }),
        "platens.elastic.metal",
        "is the law of the platens' own material, and layers of others take all of their thickness. "
        "Allowed: elastic.");
    take(metal_faults(*p_.elastic->metal, "platens.elastic.metal.", p_.material.young_modulus,
                      "platens.young_modulus"));
  }

  bool has_own_material(Side which) const {
    const PlatenSide *side = p_.side(which);
    if (side == nullptr) return false;
    const std::vector<PlatenLayer> &layers = side->layers.empty() ? p_.elastic->layers : side->layers;
    double sum = 0; // m
    for (const PlatenLayer &layer : layers)
      sum += layer.thickness;
    const bool rest =
        !side->grid && sum < (1 - 1e-9) * (side->thickness > 0 ? side->thickness : p_.thickness);
    return layers.empty() || rest ||
           std::any_of(layers.begin(), layers.end(), [](const PlatenLayer &layer) { return layer.own; });
  }

  void machine() {
    refuse_if(l_.start_strain > 0, "platens.machine.stiffness",
              "is not carried to a start without inertia. Allowed: `loading.start_strain` = 0.");
    refuse_if(p_.machine.damping == 0 && has_servo(), "platens.machine.damping",
              "lets a servo swing on the spring. Allowed: above 0, or no `loading.servo`, no `loading.cell` "
              "and no stage that asks the top platen for a stress.");
  }

  bool is_disc() const { return shape_ != nullptr && shape_->kind == dem::ShapeKind::disc; }

  void no_seat() {
    const std::string why =
        "is of cylinders and boxes: over the rim of a disc a platen would turn away. Allowed: ";
    refuse_if(p_.spherical_seat, "platens.spherical_seat", why + "fixed.");
    refuse_if(p_.seat_friction_arm != 0, "platens.seat_friction_arm", why + "0.");
    refuse_if(p_.eccentricity != 0, "platens.eccentricity", why + "0.");
  }

  void seat() {
    refuse_if(!p_.spherical_seat, "platens.seat_friction_arm",
              "is of a platen on a seat. Allowed: 0, or `platens.spherical_seat` spherical.");
    refuse_if(p_.seat_friction_arm > 0 && p_.elastic.has_value(), "platens.seat_friction_arm",
              "is of a rigid platen. Allowed: 0, or rigid platens.");
    refuse_if(p_.span > 0, "platens.spherical_seat", "does not go with three point bending. Allowed: fixed.");
    refuse_if(!verlet(), "platens.spherical_seat",
              "needs `ModelSettings.scheme` = velocity verlet. Allowed: fixed.");
    refuse_if(l_.start_strain > 0, "platens.spherical_seat",
              "needs `loading.start_strain` = 0: the static solve is between ends that do not turn. Allowed: "
              "fixed.");
  }

  // A load beside the axis, and a platen that is not square to it.
  void oblique() {
    const auto with = [&](bool broken, const std::string &why, const std::string &allowed) {
      refuse_if(broken, p_.tilt != 0 ? "platens.tilt" : "platens.eccentricity", why + " Allowed: " + allowed);
    };
    refuse_if(p_.eccentricity != 0 && !p_.spherical_seat && !is_disc(), "platens.eccentricity",
              "is of a platen that turns about the load. Allowed: 0, or `platens.spherical_seat` spherical.");
    if (shape_ != nullptr && !is_disc()) {
      const double half = half_width(*shape_);
      refuse_if(std::abs(p_.eccentricity) >= half, "platens.eccentricity",
                "puts the load beside the specimen. Allowed: -" + text_of(half) + " ... " + text_of(half) +
                    " m, without its ends.");
    }
    refuse_if(p_.tilt != 0 && p_.elastic.has_value(), "platens.tilt",
              "is of a rigid platen. Allowed: 0, or rigid platens.");
    with(p_.glued, "needs `platens.glued` = contact: what is glued fits.", "0.");
    with(p_.span > 0, "does not go with three point bending.", "0.");
    with(has_sides(), "does not go with platens on the sides.", "0.");
    with(l_.start_strain > 0, "needs `loading.start_strain` = 0: the static solve is between square ends.",
         "0.");
  }

  void faces() {
    const auto with = [&](bool broken, const std::string &why) {
      refuse_if(broken, "ends", why + " Allowed: ground.");
    };
    refuse_if(!(s_.end_height > 0), "end_height",
              "is not set: ends that are not flat have one. Allowed: above 0 m.");
    with(p_.glued, "needs `platens.glued` = contact: what is glued fits.");
    with(p_.span > 0, "does not go with three point bending.");
    with(l_.start_strain > 0, "needs `loading.start_strain` = 0: the static solve is between flat ends.");
    with(is_disc(), "is of cylinders and boxes: a disc is pressed on its rim.");
  }

  void hertz() {
    refuse_if(p_.glued, "platens.contact", "presses alone, and ends are glued. Allowed: as grains, linear.");
    refuse_if(l_.start_strain > 0, "loading.start_strain",
              "is solved for with linear springs on the platens. Allowed: 0, or `platens.contact` linear.");
  }

  void start() {
    const auto refuse_start = [&](bool broken, const std::string &why) {
      refuse_if(broken, "loading.start_strain", why + " Allowed: 0.");
    };
    refuse_start(l_.tension || l_.wall || alone() || p_.span > 0, "needs compression: the solve presses.");
    refuse_start(l_.cell.has_value(), "does not go with `loading.cell`.");
    refuse_start(l_.servo, "needs `loading.servo` = motion.");
    refuse_start(!bonded(), "needs bonds to solve for.");
    refuse_start(remembers(), "needs bonds without a memory: theirs answer to the whole path.");
    refuse_start(norm(s_.model.gravity) > 0, "does not go with gravity.");
    refuse_start(has_sides(), "does not go with platens on the sides.");
    refuse_if(l_.start_strain >= l_.target_strain, "loading.start_strain",
              "is not below `loading.target_strain` = " + text_of(l_.target_strain) + ".");
    refuse_if(!l_.unload_at.empty() && l_.start_strain >= l_.unload_at.front(), "loading.start_strain",
              "is not below the first of `loading.unload_at`.");
  }

  void bending() {
    const auto with = [&](bool broken, const std::string &member, const std::string &allowed) {
      refuse_if(broken, member, "does not go with three point bending. Allowed: " + allowed + ".");
    };
    refuse_if(!are_ground(s_.ends), "ends",
              "would let a bar rock on its outermost spheres. Allowed: ground.");
    refuse_if(p_.strip_width == 0, "platens.strip_width",
              "is not set: a bar is bent by strips. Allowed: > 0 m.");
    with(p_.glued, "platens.glued", "contact");
    with(l_.servo, "loading.servo", "motion");
    with(l_.cell.has_value(), "loading.cell", "none");
    refuse_if(!bonded(), "model.bond", "leaves a heap of grains, no bar to bend. Allowed: any other.");
    refuse_if(p_.strip_width > 0 && !(p_.span > p_.strip_width), "platens.span",
              "leaves no gap between the lower strips. Allowed: above `platens.strip_width`, " +
                  text_of(p_.strip_width) + " m.");
    if (shape_ == nullptr) return;
    if (shape_->kind != dem::ShapeKind::box)
      return refuse("platens.span", "bends bars of rectangular section. Allowed: a specimen that is a box.");
    refuse_if(p_.span + p_.strip_width > shape_->width_x, "platens.span",
              "is too long for a bar of " + text_of(shape_->width_x) +
                  " m: the lower strips have to lie under it. Allowed: up to " +
                  text_of(shape_->width_x - p_.strip_width) + " m.");
  }

  void notch(const dem::Shape &shape) {
    constexpr double deepest = 0.9; // of the bar
    if (!(p_.span > 0))
      return refuse("specimen.notch_depth", "is of bars that are bent in three points. Allowed: 0.");
    refuse_if(shape.notch.depth > deepest * shape.height, "specimen.notch_depth",
              "leaves less than a tenth of the depth, " + text_of(shape.height) + " m. Allowed: up to " +
                  text_of(deepest * shape.height) + " m.");
    refuse_if(shape.notch.width >= p_.span - p_.strip_width, "specimen.notch_width",
              "reaches over the lower strips. Allowed: below " + text_of(p_.span - p_.strip_width) + " m.");
  }

  void cycles() {
    refuse_if(!std::is_sorted(l_.unload_at.begin(), l_.unload_at.end()), "loading.unload_at",
              "does not ascend.");
    refuse_if(l_.unload_at.back() >= l_.target_strain, "loading.unload_at",
              "goes beyond `loading.target_strain` = " + text_of(l_.target_strain) + ".");
    refuse_if(alone() || l_.servo, "loading.unload_at", "needs platens that are driven by motion.");
  }

  void lateral() {
    refuse_if(l_.wall && l_.cell, "loading.cell", "does not go with uniaxial strain. Allowed: none.");
  }

  void cell() {
    refuse_if(!bonded(), "loading.cell",
              "needs bonds: they tell the specimen from what has come loose. Allowed: none.");
    refuse_if(l_.servo, "loading.servo",
              "does not go with `loading.cell`: the pressure holds the platen at first, then it moves. "
              "Allowed: motion.");
  }

  void sides() {
    const std::string first = p_.left    ? "platens.left"
                              : p_.right ? "platens.right"
                              : p_.front ? "platens.front"
                                         : "platens.back";
    refuse_if(shape_ != nullptr && shape_->kind != dem::ShapeKind::box, first,
              "presses a flat side. Allowed: a specimen that is a box.");
    refuse_if(p_.span > 0, first, "does not go with `platens.span`: a bar is bent by strips.");
    const auto same_sides = [&](bool pressed, const std::string &by) {
      refuse_if(pressed, first,
                "does not go with `loading." + by + "`, which presses the same sides. Allowed: one of both.");
    };
    same_sides(l_.cell.has_value(), "cell"), same_sides(l_.wall, "wall");
    refuse_if(l_.tension, first,
              "does not go with `loading.tension`: between sides a specimen is compressed. Allowed: top and "
              "bottom alone, or compression.");
    refuse_if(p_.glued, first,
              "does not go with `platens.glued`. Allowed: top and bottom alone, or contact.");
  }

  void stages() {
    const auto with = [&](bool broken, const std::string &member, const std::string &allowed) {
      refuse_if(broken, member, "does not go with stages. Allowed: " + allowed + ".");
    };
    with(l_.tension || l_.wall || alone(), "loading.tension", "compression, three point bending");
    with(l_.servo, "loading.servo", "motion");
    with(l_.start_strain > 0, "loading.start_strain", "0");
    with(!l_.unload_at.empty(), "loading.unload_at", "none");
    with(l_.cell && l_.cell->path != 0, "loading.cell.path", "0");
    StageScope scope;
    for (const Side side : all_sides)
      if (p_.side(side) != nullptr) scope.platens.push_back(side);
    scope.cell = l_.cell.has_value();
    scope.rate = !std::isnan(l_.rate) || l_.wave_transits > 0;
    scope.bonded = bonded();
    scope.bent = p_.span > 0;
    scope.notched = scope.bent && (shape_ == nullptr || shape_->notch.is_there());
    try {
      require_stages(l_.stages, scope);
    } catch (const BadSetup &e) {
      refuse(e.member(), e.reason());
    }
  }

  bool bonded() const { return s_.model.bond.has_value(); }
  bool remembers() const {
    return bonded() &&
           dem::BondLaws::holds(s_.model.bond->index(), [](auto *law) { return law->has_history; });
  }
  bool verlet() const { return s_.model.scheme == dem::Scheme::velocity_verlet; }
  bool alone() const { return l_.cell && l_.cell->alone; }
  bool has_sides() const { return p_.left || p_.right || p_.front || p_.back; }
  bool has_servo() const {
    const auto on_top = [](const SideControl &control) {
      const std::vector<Side> sides = sides_of(control.side);
      return control.mode != SideControl::Mode::rate && control.mode != SideControl::Mode::hold &&
             !widening_of(control.mode) && std::count(sides.begin(), sides.end(), Side::top) > 0;
    };
    return l_.servo || l_.cell ||
           std::any_of(l_.stages.begin(), l_.stages.end(), [&](const StageSettings &stage) {
             return std::any_of(stage.controls.begin(), stage.controls.end(), on_top);
           });
  }

  const PlatenTestSettings &s_;
  const PlatenSettings &p_;
  const LoadingSettings &l_;
  const dem::Shape *shape_;
  std::vector<Fault> found_;
};

} // namespace

std::vector<Fault> faults(const PlatenTestSettings &settings, const dem::Shape *shape) {
  return Rules(settings, shape).all();
}

void require_no_fault(const PlatenTestSettings &settings, const dem::Shape &shape) {
  const std::vector<Fault> found = faults(settings, &shape);
  if (!found.empty()) throw BadSetup(found.front().member, found.front().reason);
}

} // namespace platen::coupling
