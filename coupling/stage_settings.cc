#include "coupling/stage_settings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/shortest_text.h"
#include "coupling/boundary.h"

namespace platen::coupling {

using Ask = SideAsk::Ask;
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

std::optional<Widening> widening_of(Ask ask) {
  if (ask == Ask::circumferential) return Widening::circumference;
  if (ask == Ask::mouth_opening) return Widening::mouth;
  return std::nullopt;
}

bool needs(const StageSettings &stage, Widening of) {
  return std::any_of(stage.asks.begin(), stage.asks.end(),
                     [&](const SideAsk &ask) { return widening_of(ask.ask) == of; }) ||
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

  void asks() const {
    if (!scope_.bonded)
      fail("until",
           "ends a stage of a specimen without bonds: a wave over them sets how fast it follows. Allowed: "
           "bonds.");
    if (stage_.asks.empty())
      fail("until", "ends a stage that asks nothing. Allowed: a side that is asked something.");
    for (std::size_t k = 0; k < stage_.asks.size(); ++k) {
      one(stage_.asks[k]);
      for (std::size_t other = 0; other < k; ++other)
        if (overlap(stage_.asks[k].side, stage_.asks[other].side))
          fail(stage_.asks[k], "asks what `" + member_ + name_of(stage_.asks[other].side) +
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
  [[noreturn]] void fail(const SideAsk &ask, const std::string &reason) const {
    fail(name_of(ask.side), reason);
  }

  bool has_platen(SideGroup group) const {
    const std::vector<Side> sides = sides_of(group);
    return std::any_of(sides.begin(), sides.end(), [&](Side side) {
      return std::count(scope_.platens.begin(), scope_.platens.end(), side) > 0;
    });
  }
  bool is_cell(SideGroup group) const { return group == SideGroup::lateral && scope_.cell; }

  void one(const SideAsk &ask) const {
    const bool pressed = is_cell(ask.side);
    if (!pressed && !has_platen(ask.side))
      fail(ask, "asks a side that nothing presses. Allowed: sides with a platen, and lateral in a cell.");
    if (ask.ask == Ask::pressure && !pressed)
      fail(ask, "asks a pressure of platens. Allowed: stress, or lateral in a cell.");
    if (pressed && (ask.ask == Ask::rate || ask.ask == Ask::stress || widening_of(ask.ask)))
      fail(ask, "asks what a cell cannot. Allowed: pressure, share of a side, hold, free.");
    if ((ask.ask == Ask::stress || ask.ask == Ask::pressure) && !(ask.value >= 0))
      fail(ask, "pulls. Allowed: 0 and more, compression.");
    const bool by_loading = (ask.ask == Ask::rate && std::isnan(ask.value)) || widening_of(ask.ask);
    if (by_loading && !scope_.rate)
      fail(ask, "names no rate, nor does the loading. Allowed: a speed, or a `loading.rate`.");
    if (ask.ask == Ask::rate && ask.value == 0) fail(ask, "goes nowhere. Allowed: hold.");
    if (ask.ask == Ask::share) share(ask);
    if (scope_.bent) bent(ask);
    if (const auto of = widening_of(ask.ask)) widening(ask, *of);
  }

  // Servos are tuned to a specimen that is pressed along its length; a bar that is bent is far softer.
  void bent(const SideAsk &ask) const {
    if (ask.ask != Ask::rate && ask.ask != Ask::hold && ask.ask != Ask::mouth_opening)
      fail(ask, "does not go with three point bending. Allowed: rate, unload, hold, cmod rate.");
  }

  void widening(const SideAsk &ask, Widening of) const {
    if (ask.side != SideGroup::axial)
      fail(ask, std::string("is led by the ") +
                    (of == Widening::mouth ? "opening of a notch" : "circumferential strain") +
                    ". Allowed: axial alone is.");
    if (!(ask.value > 0)) fail(ask, "does not let the specimen widen. Allowed: above 0.");
    if (of == Widening::mouth && !scope_.notched) fail(ask, no_notch);
  }

  void share(const SideAsk &ask) const {
    if (!(ask.value > 0)) fail(ask, "is no share. Allowed: above 0.");
    if (overlap(ask.side, ask.of)) fail(ask, "is a share of its own stress. Allowed: of another side.");
    if (ask.of == SideGroup::lateral || !has_platen(ask.of))
      fail(ask, "follows a side without a platen. Allowed: a side, or two opposite ones, with a platen.");
    for (const SideAsk &other : stage_.asks)
      if (other.ask == Ask::share && overlap(other.side, ask.of) && overlap(other.of, ask.side))
        fail(ask, "follows a side that follows it. Allowed: one of both is asked something else.");
  }

  bool asks_any(std::initializer_list<Ask> kinds) const {
    return std::any_of(stage_.asks.begin(), stage_.asks.end(), [&](const SideAsk &ask) {
      return std::count(kinds.begin(), kinds.end(), ask.ask) > 0;
    });
  }

  void one(const StageUntil &end) const {
    if (end.what == Reached::settled) {
      if (!asks_any({Ask::stress, Ask::share, Ask::pressure, Ask::free}))
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
    const bool share = end.what == Reached::share_of_peak || end.what == Reached::share_of_start;
    if (share && end.value >= 1) fail("until", "never falls. Allowed: a share below 1.");
    const bool of_side = share || end.what == Reached::stress || end.what == Reached::strain ||
                         end.what == Reached::strain_change;
    if (of_side && (end.of == SideGroup::lateral || !has_platen(end.of)))
      fail("until",
           "looks at a side without a platen. Allowed: a side, or two opposite ones, with a platen.");
    if (end.what == Reached::stress && held_below(end))
      fail("until",
           "waits for a stress that its side is not led to. Allowed: up to what is asked of it, or "
           "settled.");
  }

  // The side's servo is controlled to a stress below the one that ends the stage.
  bool held_below(const StageUntil &end) const {
    return std::any_of(stage_.asks.begin(), stage_.asks.end(), [&](const SideAsk &ask) {
      return ask.side == end.of && ask.ask == Ask::stress && end.value > ask.value;
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
    check.asks();
    check.until();
  }
}

} // namespace platen::coupling
