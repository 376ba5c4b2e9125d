#include "coupling/stage_settings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/shortest_text.h"
#include "coupling/boundary.h"

namespace platen::coupling {

using Mode = SideControl::Mode;
using Reached = Until::Reached;

std::string name_of(SideGroup group) {
  static const std::array<const char *, all_side_groups.size()> names{
      "axial", "lateral", "lateral_x", "lateral_y", "bottom", "top", "left", "right", "front", "back"};
  return names.at(static_cast<std::size_t>(group));
}

std::string words_of(SideGroup group) {
  std::string words = name_of(group);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::vector<Side> sides_of(SideGroup group) {
  switch (group) {
    case SideGroup::axial:
      return {Side::bottom, Side::top};
    case SideGroup::lateral:
      return {Side::left, Side::right, Side::front, Side::back};
    case SideGroup::lateral_x:
      return {Side::left, Side::right};
    case SideGroup::lateral_y:
      return {Side::front, Side::back};
    case SideGroup::bottom:
      return {Side::bottom};
    case SideGroup::top:
      return {Side::top};
    case SideGroup::left:
      return {Side::left};
    case SideGroup::right:
      return {Side::right};
    case SideGroup::front:
      return {Side::front};
    default:
      return {Side::back};
  }
}

std::optional<Widening> widening_of(Mode mode) {
  if (mode == Mode::circumferential) return Widening::circumference;
  if (mode == Mode::mouth_opening) return Widening::mouth;
  return std::nullopt;
}

bool needs(const StageSettings &stage, Widening of) {
  return std::any_of(stage.controls.begin(), stage.controls.end(),
                     [&](const SideControl &control) { return widening_of(control.mode) == of; }) ||
         std::any_of(stage.until.begin(), stage.until.end(),
                     [&](const StageUntil &end) { return widening_of(end.what) == of; });
}

namespace {

bool overlap(SideGroup one, SideGroup other) {
  const std::vector<Side> a = sides_of(one), b = sides_of(other);
  return std::any_of(a.begin(), a.end(), [&](Side side) { return std::count(b.begin(), b.end(), side) > 0; });
}

class StageCheck {
public:
  StageCheck(const StageSettings &stage, std::size_t number, const StageScope &scope)
      : stage_(stage), member_("loading.stage_" + std::to_string(number) + "."), scope_(scope) {}

  void controls() const {
    if (!scope_.bonded)
      fail("until",
           "ends a stage of a specimen without bonds: a wave over them sets how fast it follows. Allowed: "
           "bonds.");
    if (stage_.controls.empty())
      fail("until", "ends a stage that asks nothing. Allowed: a side that is asked something.");
    for (std::size_t k = 0; k < stage_.controls.size(); ++k) {
      one(stage_.controls[k]);
      for (std::size_t other = 0; other < k; ++other)
        if (overlap(stage_.controls[k].side, stage_.controls[other].side))
          fail(stage_.controls[k], "asks what `" + member_ + name_of(stage_.controls[other].side) +
                                       "` asks too. Allowed: each side once.");
    }
  }

  void until() const {
    if (stage_.until.empty())
      fail("until",
           "is not set: the stage has no end. Allowed: strain, strain change, stress, share of peak, "
           "share of start, circumferential strain, cmod, time, settled.");
    for (const StageUntil &end : stage_.until)
      one(end);
  }

private:
  [[noreturn]] void fail(const std::string &key, const std::string &reason) const {
    throw BadSetup(member_ + key, reason);
  }
  [[noreturn]] void fail(const SideControl &control, const std::string &reason) const {
    fail(name_of(control.side), reason);
  }

  bool has_platen(SideGroup group) const {
    const std::vector<Side> sides = sides_of(group);
    return std::any_of(sides.begin(), sides.end(), [&](Side side) {
      return std::count(scope_.platens.begin(), scope_.platens.end(), side) > 0;
    });
  }
  bool is_cell(SideGroup group) const { return group == SideGroup::lateral && scope_.cell; }

  void one(const SideControl &control) const {
    const bool pressed = is_cell(control.side);
    if (!pressed && !has_platen(control.side))
      fail(control, "asks a side that nothing presses. Allowed: sides with a platen, and lateral in a cell.");
    if (control.mode == Mode::pressure && !pressed)
      fail(control, "asks a pressure of platens. Allowed: stress, or lateral in a cell.");
    if (pressed && (control.mode == Mode::rate || control.mode == Mode::stress || widening_of(control.mode)))
      fail(control, "asks what a cell cannot. Allowed: pressure, share of a side, hold, free.");
    if ((control.mode == Mode::stress || control.mode == Mode::pressure) && !(control.value >= 0))
      fail(control, "pulls. Allowed: 0 and more, compression.");
    const bool by_loading =
        (control.mode == Mode::rate && std::isnan(control.value)) || widening_of(control.mode);
    if (by_loading && !scope_.rate)
      fail(control, "names no rate, nor does the loading. Allowed: a speed, or a `loading.rate`.");
    if (control.mode == Mode::rate && control.value == 0) fail(control, "goes nowhere. Allowed: hold.");
    if (control.mode == Mode::fraction) fraction(control);
    if (scope_.bent) bent(control);
    if (const auto of = widening_of(control.mode)) widening(control, *of);
  }

  // Servos are tuned to a specimen that is pressed along its length; a bar that is bent is far softer.
  void bent(const SideControl &control) const {
    if (control.mode != Mode::rate && control.mode != Mode::hold && control.mode != Mode::mouth_opening)
      fail(control, "does not go with three point bending. Allowed: rate, unload, hold, cmod rate.");
  }

  void widening(const SideControl &control, Widening of) const {
    if (control.side != SideGroup::axial)
      fail(control, std::string("is led by the ") +
                        (of == Widening::mouth ? "opening of a notch" : "circumferential strain") +
                        ". Allowed: axial alone is.");
    if (!(control.value > 0)) fail(control, "does not let the specimen widen. Allowed: above 0.");
    if (of == Widening::mouth && !scope_.notched) fail(control, no_notch);
  }

  void fraction(const SideControl &control) const {
    if (!(control.value > 0)) fail(control, "is no share. Allowed: above 0.");
    if (overlap(control.side, control.of))
      fail(control, "is a share of its own stress. Allowed: of another side.");
    if (control.of == SideGroup::lateral || !has_platen(control.of))
      fail(control, "follows a side without a platen. Allowed: a side, or two opposite ones, with a platen.");
    for (const SideControl &other : stage_.controls)
      if (other.mode == Mode::fraction && overlap(other.side, control.of) && overlap(other.of, control.side))
        fail(control, "follows a side that follows it. Allowed: one of both is asked something else.");
  }

  bool prescribes_any(std::initializer_list<Mode> modes) const {
    return std::any_of(stage_.controls.begin(), stage_.controls.end(), [&](const SideControl &control) {
      return std::count(modes.begin(), modes.end(), control.mode) > 0;
    });
  }

  void one(const StageUntil &end) const {
    if (end.what == Reached::settled) {
      if (!prescribes_any({Mode::stress, Mode::fraction, Mode::pressure, Mode::free}))
        fail("until",
             "waits for a stress that no side is asked. Allowed: settled with a stress, a share or a "
             "pressure.");
      return;
    }
    if (!std::isfinite(end.value)) fail("until", "has no value.");
    if (end.what != Reached::time && end.what != Reached::stress && end.value <= 0)
      fail("until", "ends at " + text_of(end.value) + ". Allowed: above 0.");
    if (end.what == Reached::mouth_opening && !scope_.notched) fail("until", no_notch);
    if (end.what == Reached::circumferential_strain && scope_.bent)
      fail("until", "looks at a circumference, and a bar is bent. Allowed: cmod, of a notched bar.");
    if (end.what == Reached::time && !(end.value > 0))
      fail("until", "ends at once. Allowed: a time above 0 s.");
    const bool fraction = end.what == Reached::fraction_of_peak || end.what == Reached::fraction_of_start;
    if (fraction && end.value >= 1) fail("until", "never falls. Allowed: a share below 1.");
    const bool of_side = fraction || end.what == Reached::stress || end.what == Reached::strain ||
                         end.what == Reached::strain_change;
    if (of_side && (end.of == SideGroup::lateral || !has_platen(end.of)))
      fail("until",
           "looks at a side without a platen. Allowed: a side, or two opposite ones, with a platen.");
    if (end.what == Reached::stress && controlled_below(end))
      fail("until",
           "waits for a stress that its side is not led to. Allowed: up to what is asked of it, or "
           "settled.");
  }

  // Whether the servo of the side has a target below the stress that ends the stage.
  bool controlled_below(const StageUntil &end) const {
    return std::any_of(stage_.controls.begin(), stage_.controls.end(), [&](const SideControl &control) {
      return control.side == end.of && control.mode == Mode::stress && end.value > control.value;
    });
  }

  static constexpr const char *no_notch =
      "looks at the mouth of a notch, and there is none. Allowed: of a bar that is notched and bent.";

  const StageSettings &stage_;
  std::string member_;
  const StageScope &scope_;
};

} // namespace

void require_stages(const std::vector<StageSettings> &stages, const StageScope &scope) {
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const StageCheck check(stages[k], k + 1, scope);
    check.controls();
    check.until();
  }
}

} // namespace platen::coupling
