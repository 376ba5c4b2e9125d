// Figures (figures.h) of how a specimen failed: damage, dead zones, crack planes, acoustic emission.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "apps/run/figure_list.h"
#include "apps/run/history.h"
#include "base/pi.h"
#include "dem/measure/acoustic_emission.h"
#include "dem/measure/cracks.h"
#include "dem/measure/dead_zone.h"
#include "dem/measure/openings.h"

namespace platen::apps {

// Of both states in which failure is measured: at 0.8 of the peak, after it, and at the end ("final_").
template <class List>
void list_damage(List &list) {
  for (const bool last : {false, true}) {
    const std::string at = last ? "final_" : "";
    const unsigned fallen = last ? 0u : damage | of_every_test, spread = last ? 0u : fallen | compressed;
    const auto line = [&](const char *label) { return last ? Line{} : Line{label, "{:.2f}"}; };
    list.add(at + "end_damage_top", "1", fallen, line("damage of the top, after the peak"),
             [=](auto &t) { return t.failure(last).damage.end_top; });
    list.add(at + "end_damage_bottom", "1", fallen, line("damage of the bottom"),
             [=](auto &t) { return t.failure(last).damage.end_bottom; });
    list.add(at + "worse_end_damage", "1", fallen,
             [=](auto &t) { return t.failure(last).damage.worse_end(); });
    list.add(at + "middle_damage", "1", fallen, line("damage of the middle"),
             [=](auto &t) { return t.failure(last).damage.middle; });
    list.add(at + "end_spread", "1", spread, line("end spread"),
             [=](auto &t) { return t.failure(last).end_spread; });
  }
  list.add("barrel_at_peak", "1", peak | along_z | of_every_test, {"barrel at peak", "{:.2f}"},
           [](auto &t) { return t.results.barrel_at_peak(); });
  list.add("fragments", "1", of_every_test, [](auto &t) { return t.fragments.count; });
  list.add("loose_particles", "1", [](auto &t) { return t.fragments.single; });
}

// What has moved with a platen since the peak, and whether that is a cone.
template <class List>
void list_dead_zones(List &list, bool last) {
  using Zone = dem::DeadZone;
  const std::string at = last ? "final_" : "";
  for (const dem::End end : {dem::top_end, dem::bottom_end}) {
    const bool top = end == dem::top_end;
    const std::string cone = at + (top ? "cone_top" : "cone_bottom");
    const auto number = [&](const char *key, const char *unit, double Zone::*value, double of_unit = 1) {
      list.add(cone + "/" + key, unit, [=](auto &t) { return t.dead_zone(last, end).*value / of_unit; });
    };
    const unsigned cone_of = top ? top_cone : bottom_cone;
    list.where(everywhere);
    list.add_object(cone, last ? 0u : damage | compressed | of_every_test | cone_of);
    list.where([=](auto &t) { return t.has_pattern(last) && t.dead_zone(last, end).is_cone(); });
    number("base_ratio", "1", &Zone::base_ratio);
    number("height_m", "m", &Zone::height);
    number("half_angle_deg", "degree", &Zone::half_angle, degree);
    number("volume_fraction", "1", &Zone::volume_fraction);
    number("apex_depth_m", "m", &Zone::apex_depth);
    number("tilt_deg", "degree", &Zone::tilt, degree);
    list.add(cone + "/apex_m", "", [=](auto &t) { return list_of(t.dead_zone(last, end).apex); });
    list.add(cone + "/axis", "", [=](auto &t) { return list_of(t.dead_zone(last, end).axis); });
    number("roundness", "1", &Zone::roundness);
    number("straightness", "1", &Zone::straightness);
    number("confidence", "1", &Zone::confidence);
  }
  for (const dem::End end : {dem::top_end, dem::bottom_end}) {
    const std::string zone = at + (end == dem::top_end ? "dead_zone_top" : "dead_zone_bottom");
    list.where(everywhere);
    list.add_object(zone);
    list.where([=](auto &t) {
      return t.has_pattern(last) && t.dead_zone(last, end).verdict != dem::DeadZoneVerdict::not_measured;
    });
    list.add(zone + "/verdict", "", [=](auto &t) { return words_of(t.dead_zone(last, end).verdict); });
    list.add(zone + "/base_ratio", "1", [=](auto &t) { return t.dead_zone(last, end).base_ratio; });
    list.add(zone + "/volume_fraction", "1", [=](auto &t) { return t.dead_zone(last, end).volume_fraction; });
  }
}

template <class List>
void list_pattern(List &list, bool last) {
  const std::string at = last ? "final_" : "", planes = at + "crack_planes", largest = planes + "/largest";
  const auto of_all = [&](const std::string &key, const char *unit, auto value) {
    list.add(planes + key, unit, [=](auto &t) { return value(t.failure(last).planes); });
  };
  list.where(everywhere);
  list.add(at + "pattern", "", last ? 0u : damage | compressed, {last ? "" : "pattern"},
           [=](auto &t) { return t.has_pattern(last) ? Json(t.word_of_pattern(last)) : Json(); });
  list.add(at + "pattern_reasons", "", 0, {last ? "" : "because"},
           [=](auto &t) { return t.has_pattern(last) ? Json(t.reasons_of_pattern(last)) : Json(); });
  list.add_object(planes);
  list.where([=](auto &t) { return t.has_failure(last); });
  of_all("/count", "1", [](auto &p) { return static_cast<int>(p.count); });
  of_all("/share", "1", [](auto &p) { return p.fraction; });
  of_all("/steep_share", "1", [](auto &p) { return p.steep_fraction; });
  of_all("/mean_inclination_deg", "degree", [](auto &p) { return p.mean_inclination / degree; });
  list.add_object(largest);
  list.where([=](auto &t) { return t.has_failure(last) && t.failure(last).planes.count > 0; });
  of_all("/largest/share", "1", [](auto &p) { return p.largest.bonds / p.broken; });
  of_all("/largest/inclination_deg", "degree", [](auto &p) { return p.largest.inclination / degree; });
  of_all("/largest/flatness", "1", [](auto &p) { return p.largest.flatness; });
  of_all("/largest/extent_m", "m", [](auto &p) { return p.largest.extent; });
  list.where(everywhere);
}

// How wide cracks are at the end, and what leads and flows through the specimen.
template <class List>
void list_crack_widths(List &list) {
  const auto add = [&](const std::string &key, const char *unit, auto value) {
    list.add("crack_widths/" + key, unit, [=](auto &t) { return value(*t.widths); });
  };
  list.add_object("crack_widths");
  list.where([](auto &t) { return t.widths.has_value(); });
  add("open", "1", [](auto &w) { return w.open; });
  add("largest_m", "m", [](auto &w) { return w.largest; });
  add("mean_m", "m", [](auto &w) { return w.mean; });
  for (std::size_t k = 0; k < dem::crack_width_limits.size(); ++k)
    add(fmt::format("share_above_{:.0f}_um", 1e6 * dem::crack_width_limits[k]), "1",
        [=](auto &w) { return w.wider[k]; });
  add("volume_m3", "m3", [](auto &w) { return w.volume; });
  list.add("crack_widths/roughness", "1", [](auto &t) { return t.scene.output.crack_roughness; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    add(fmt::format("through_{}_m", "xyz"[axis]), "m", [=](auto &w) { return w.through[axis]; });
    add(fmt::format("permeability_{}_m2", "xyz"[axis]), "m2", [=](auto &w) { return w.permeability[axis]; });
  }
  list.where(everywhere);
}

// What was counted while bonds broke.
template <class List>
void list_emission(List &list) {
  list.add("crack_rose", "", [](auto &t) {
    return t.emission.pulses.empty() ? Json() : Json(t.emission.rose.over_isotropic());
  });
  list.add_object("acoustic");
  list.where([](auto &t) { return t.has_emission(); });
  list.add("acoustic/cracks", "1", [](auto &t) { return t.emission.pulses.size(); });
  list.add("acoustic/events", "1", 0, {"acoustic events", "{:.0f}"},
           [](auto &t) { return t.emission.events.size(); });
  list.add("acoustic/largest_cracks", "1", [](auto &t) { return t.emission.largest_cracks(); });
  list.add("acoustic/largest_magnitude", "1", 0, {"largest magnitude", "{:.1f}"},
           [](auto &t) { return t.emission.largest_magnitude(); });
  for (const bool after : {false, true}) {
    const std::string b = after ? "acoustic/b_after" : "acoustic/b_before";
    const auto add = [&](const char *key, const char *unit, const Line &line, auto value) {
      list.add(b + key, unit, 0, line,
               [=](auto &t) { return value(after ? t.emission.after : t.emission.before); });
    };
    add("", "1", {after ? "b-value after the peak" : "b-value before the peak", "{:.2f}"},
        [](auto &v) { return v.b; });
    add("_error", "1", {"its error", "{:.2f}"}, [](auto &v) { return v.error; });
    add("_events", "1", {}, [](auto &v) { return static_cast<long>(v.events); });
    add("_limit", "1", {}, [](auto &v) { return v.limit; });
    add("_upper", "1", {}, [](auto &v) { return std::isfinite(v.upper) ? v.upper : not_measured; });
    add("_above", "1", {}, [](auto &v) { return static_cast<long>(v.above); });
    add("_reason", "", {}, [](auto &v) { return word_or_null(reason_against(v)); });
  }
  list.where(everywhere);
}

} // namespace platen::apps
