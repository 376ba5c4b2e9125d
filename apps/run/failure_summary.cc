#include "apps/run/failure_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/summary.h"
#include "base/pi.h"
#include "coupling/program_of_test.h"

namespace platen::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = pi / 180;

Json json_of(const Vector3 &v) {
  return Json::array({v.x, v.y, v.z});
}

Json json_of(const dem::DeadZone &zone) {
  if (!zone.is_cone()) return nullptr;
  return {{"base_ratio", zone.base_ratio},
          {"height_m", zone.height},
          {"half_angle_deg", zone.half_angle / degree},
          {"volume_fraction", zone.volume_fraction},
          {"apex_depth_m", zone.apex_depth},
          {"tilt_deg", zone.tilt / degree},
          {"apex_m", json_of(zone.apex)},
          {"axis", json_of(zone.axis)},
          {"roundness", zone.roundness},
          {"straightness", zone.straightness},
          {"confidence", zone.confidence}};
}

// Of what moves with a platen, cone or not.
Json json_of_zone(const dem::DeadZone &zone) {
  if (zone.verdict == dem::DeadZoneVerdict::not_measured) return nullptr;
  return {{"verdict", dem::words_of(zone.verdict)},
          {"base_ratio", zone.base_ratio},
          {"volume_fraction", zone.volume_fraction}};
}

Json json_of(const dem::ConePiece &piece) {
  if (!piece.is_cone()) return nullptr;
  return {{"height_m", piece.height},
          {"half_angle_deg", piece.half_angle / degree},
          {"volume_fraction", piece.volume_fraction},
          {"apex_depth_m", piece.apex_depth},
          {"tilt_deg", piece.tilt / degree},
          {"apex_m", json_of(piece.apex)},
          {"axis", json_of(piece.axis)},
          {"confidence", piece.confidence}};
}

Json json_of(const dem::CrackPlanes &planes) {
  const dem::CrackPlane &largest = planes.largest;
  Json j{{"count", static_cast<int>(planes.count)},
         {"share", planes.share},
         {"steep_share", planes.steep_share},
         {"mean_inclination_deg", planes.mean_inclination / degree},
         {"largest", nullptr}};
  if (planes.count > 0)
    j["largest"] = {{"share", largest.bonds / planes.broken},
                    {"inclination_deg", largest.inclination / degree},
                    {"flatness", largest.flatness},
                    {"extent_m", largest.extent}};
  return j;
}

Json json_of(const Emission &e) {
  int most = 0;
  for (const dem::AcousticEvent &event : e.events)
    most = std::max(most, event.cracks);
  Json j{{"cracks", e.pulses.size()},
         {"events", e.events.size()},
         {"largest_cracks", most},
         {"largest_magnitude", largest_magnitude(e)}};
  j.update(json_of_b(e.before, "b_before"));
  j.update(json_of_b(e.after, "b_after"));
  return j;
}

// Of a state that was measured.
void add_state(Json &to, const std::string &start, const Pattern &p, bool pattern) {
  const bool measured = !std::isnan(p.failure.broken_share), told = pattern && measured;
  const auto &[dead_bottom, dead_top] = p.failure.dead;
  const auto &[sound_bottom, sound_top] = p.failure.sound;
  const auto add = [&](const char *key, const Json &value) { to[start + key] = told ? value : Json(); };
  add("cone_top", json_of(dead_top));
  add("cone_bottom", json_of(dead_bottom));
  add("dead_zone_top", json_of_zone(dead_top));
  add("dead_zone_bottom", json_of_zone(dead_bottom));
  add("sound_cone_top", json_of(sound_top));
  add("sound_cone_bottom", json_of(sound_bottom));
  add("pattern", dem::word_of(dem::judge_failure(p.failure).pattern));
  add("pattern_reasons",
      Json{reason_words(p.failure), "top: " + cone_words(dead_top), "bottom: " + cone_words(dead_bottom),
           "sound piece on top: " + cone_words(sound_top), "on the bottom: " + cone_words(sound_bottom)});
  to[start + "crack_planes"] = measured ? json_of(p.failure.planes) : Json();
}

} // namespace

bool tells_pattern(const Scene &scene, const coupling::PlatenTest &problem) {
  return scene.loading.test == LoadingTest::compression && problem.shape().kind != dem::ShapeKind::disc &&
         !problem.bent() && coupling::loaded_axis(problem) == 2;
}

void add_failure(Json &to, const Scene &scene, const coupling::PlatenTest &problem, const Results &results) {
  const bool pattern = tells_pattern(scene, problem);
  add_state(to, "", results.pattern(), pattern);
  add_state(to, "final_", results.last_pattern(), pattern);
  const Emission &e = results.emission();
  to["crack_rose"] = e.pulses.empty() ? Json() : Json(e.rose.over_isotropic());
  const bool heard = scene.model.crack_log && problem.model.bonds && !std::isnan(results.last_pattern().time);
  to["acoustic"] = heard ? json_of(e) : Json();
}

std::string cone_words(const dem::DeadZone &d) {
  if (d.is_cone())
    return fmt::format(
        "r0 {:.2f}, {:.3g} mm high, half-angle {:.0f} degrees, {:.2f} of the volume, confidence {:.2f}",
        d.base_ratio, 1e3 * d.height, d.half_angle / degree, d.volume_fraction, d.confidence);
  if (std::isnan(d.base_ratio)) return fmt::format("none: {}", dem::words_of(d.verdict));
  return fmt::format("none: {} (r0 {:.2f}, {:.2f} of the volume)", dem::words_of(d.verdict), d.base_ratio,
                     d.volume_fraction);
}

std::string cone_words(const dem::ConePiece &c) {
  if (!c.is_cone()) return fmt::format("none: {}", dem::words_of(c.verdict));
  return fmt::format("{:.3g} mm high, half-angle {:.0f} degrees, {:.2f} of the volume, confidence {:.2f}",
                     1e3 * c.height, c.half_angle / degree, c.volume_fraction, c.confidence);
}

std::string reason_words(const dem::FailureMeasures &m) {
  const dem::CrackPlane &plane = m.planes.largest;
  switch (dem::judge_failure(m).by) {
    case dem::DecidedBy::two_cones:
      return m.dead[dem::top_end].is_cone() && m.dead[dem::bottom_end].is_cone()
                 ? "what moves with the platens is a cone on each"
                 : "what moves with the platens is a cone on one and a dome on the other";
    case dem::DecidedBy::one_plane:
      return fmt::format("{:.0f} % of the broken bonds lie in one plane, {:.0f} degrees from the axis",
                         100 * plane.bonds / m.planes.broken, plane.inclination / degree);
    case dem::DecidedBy::columns:
      return fmt::format("{:.0f} sound pieces reach from platen to platen", m.columns);
    case dem::DecidedBy::steep_planes:
      return fmt::format("{:.0f} % of the broken bonds lie in planes within 15 degrees of the axis",
                         100 * m.planes.steep_share);
    case dem::DecidedBy::few_broken:
      return fmt::format("{:.1f} % of the bonds are broken", 100 * m.broken_share);
    case dem::DecidedBy::crushed_end:
      return fmt::format("one end has lost {:.0f} % of its bonds", 100 * m.damage.worse_end());
    case dem::DecidedBy::nothing:
      break;
  }
  return fmt::format("damage of the ends {:.2f} and {:.2f}, of the middle {:.2f}: no rule holds",
                     m.damage.end_top, m.damage.end_bottom, m.damage.middle);
}

double largest_magnitude(const Emission &e) {
  double largest = not_measured;
  for (const dem::AcousticEvent &event : e.events)
    largest = std::fmax(largest, event.magnitude);
  return largest;
}

} // namespace platen::apps
