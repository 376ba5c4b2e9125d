#include "apps/run/peak.h"

#include <fmt/format.h>

#include <algorithm>

namespace platen::apps {
namespace {

constexpr double fallen_to = 0.98;       // of the largest stress
constexpr double gain_of_a_rise = 0.01;  // of the largest stress, in the last part of the strain
constexpr double before_last_part = 0.8; // of the largest strain
// Readings in the last part, without which a plateau is not seen.
constexpr std::size_t fewest_readings = 3;

std::size_t place_of_largest(const std::vector<CurvePoint> &curve) {
  return static_cast<std::size_t>(
      std::max_element(curve.begin(), curve.end(),
                       [](const CurvePoint &a, const CurvePoint &b) { return a.stress < b.stress; }) -
      curve.begin());
}

bool has_fallen(const std::vector<CurvePoint> &curve, std::size_t largest) {
  const CurvePoint &top = curve[largest];
  return std::any_of(curve.begin() + static_cast<std::ptrdiff_t>(largest), curve.end(),
                     [&](const CurvePoint &p) {
                       return p.damaged && p.stress <= fallen_to * top.stress &&
                              (p.by == coupling::Loads::by_widening || p.strain >= top.strain);
                     });
}

} // namespace

PeakOfCurve judge_peak(const std::vector<CurvePoint> &curve) {
  PeakOfCurve peak;
  if (curve.empty()) return peak;
  const std::size_t largest = place_of_largest(curve);
  if (!(curve[largest].stress > 0)) return peak;
  peak.largest = curve[largest].stress;
  peak.strain_of_largest = curve[largest].strain;
  for (const CurvePoint &p : curve)
    peak.strain_at_end = std::max(peak.strain_at_end, p.strain);
  double before = 0; // largest stress until the last part
  std::size_t in_last_part = 0;
  for (const CurvePoint &p : curve) {
    if (p.strain > before_last_part * peak.strain_at_end) {
      ++in_last_part;
      peak.asked = peak.asked || p.by == coupling::Loads::by_stress;
      continue;
    }
    before = std::max(before, p.stress);
  }
  peak.gained = before > 0 ? peak.largest / before - 1 : 1;
  if (has_fallen(curve, largest))
    peak.kind = PeakKind::fallen;
  else if (!peak.asked && curve.back().damaged && in_last_part >= fewest_readings &&
           peak.gained < gain_of_a_rise)
    peak.kind = PeakKind::plateau;
  return peak;
}

std::string words_against(const PeakOfCurve &peak) {
  if (peak.reached()) return "";
  if (!(peak.largest > 0)) return "no peak was reached: the platens bore nothing";
  if (peak.asked && peak.gained < gain_of_a_rise)
    return fmt::format(
        "no peak was reached: up to the strain of {:.4g} the stress had not fallen by {:.0f} % of its "
        "largest while the strain grew; it stayed at what was asked",
        peak.strain_at_end, 100 * (1 - fallen_to));
  return fmt::format(
      "no peak was reached: up to the strain of {:.4g} the stress had not fallen by {:.0f} % of its largest "
      "while the strain grew, and had gained {:.2g} % in the last fifth of the strain ({:.0f} % at most is a "
      "plateau)",
      peak.strain_at_end, 100 * (1 - fallen_to), 100 * peak.gained, 100 * gain_of_a_rise);
}

} // namespace platen::apps
