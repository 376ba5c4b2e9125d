#include "dem/measure/dead_zone_shape.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "dem/measure/cone.h"

namespace platen::dem {
namespace {

constexpr double full = 0.95; // r over Rc from which the rim cuts a section
constexpr std::size_t least_bins = 3;
constexpr std::size_t few_bins = 8; // fewer do not distinguish a dome from a cone: they are halved for that

// A sphere of the specimen, z upwards from the end plane, and whether it is dead.
struct LabelledPoint {
  Vector3 x;         // m
  double weight = 0; // its volume
  bool inside = false;
};

// The dead part of a bin of height. Spheres count where their centres are.
struct Section {
  double all = 0, volume = 0;    // m^3
  double height = 0;             // m, mean of all its spheres
  double x = 0, y = 0;           // m, centre of the dead part
  double xx = 0, yy = 0, xy = 0; // m^2, scatter about it
  double fraction() const { return all > 0 ? volume / all : 0; }
  double roundness() const { // from its second moments
    const double mean = 0.5 * (xx + yy), difference = std::hypot(0.5 * (xx - yy), xy);
    return mean + difference > 0 ? std::sqrt(std::max(0.0, (mean - difference) / (mean + difference))) : 0;
  }
};

std::vector<LabelledPoint> seen_from(const Specimen &s, const std::vector<char> &members, End end) {
  std::vector<LabelledPoint> points;
  for (std::size_t i = 0; i < s.size(); ++i) {
    Vector3 x = s.centre[i];
    if (end == top_end) x.z = s.shape.height - x.z;
    points.push_back({x, sphere_volume(s.radius[i]), members[i] != 0});
  }
  return points;
}

std::vector<Section> sections(const std::vector<LabelledPoint> &points, double height, double thickness) {
  std::vector<Section> bins(static_cast<std::size_t>(std::ceil(height / thickness)));
  for (const LabelledPoint &p : points) {
    Section &s = bins[std::min(bins.size() - 1, static_cast<std::size_t>(std::max(0.0, p.x.z / thickness)))];
    const double v = p.weight;
    s.all += v, s.height += v * p.x.z;
    if (!p.inside) continue;
    s.volume += v, s.x += v * p.x.x, s.y += v * p.x.y;
    s.xx += v * p.x.x * p.x.x, s.yy += v * p.x.y * p.x.y, s.xy += v * p.x.x * p.x.y;
  }
  for (Section &s : bins) {
    if (s.all > 0) s.height /= s.all;
    if (!(s.volume > 0)) continue;
    for (double *sum : {&s.x, &s.y, &s.xx, &s.yy, &s.xy})
      *sum /= s.volume;
    s.xx -= s.x * s.x, s.yy -= s.y * s.y, s.xy -= s.x * s.y;
  }
  return bins;
}

// value = at_zero + slope * height, by least squares.
struct Line {
  double at_zero = 0, slope = 0;
};
template <class Value, class Weight>
Line line_through(const std::vector<Section> &bins, std::size_t from, std::size_t to, const Value &value,
                  const Weight &weight) {
  double w = 0, z = 0, v = 0, zz = 0, zv = 0;
  for (std::size_t k = from; k < to; ++k) {
    const double one = weight(bins[k]), height = bins[k].height, here = value(bins[k]);
    w += one, z += one * height, v += one * here;
    zz += one * height * height, zv += one * height * here;
  }
  const double slope = (w * zv - z * v) / (w * zz - z * z);
  return {(v - slope * z) / w, slope};
}

double equivalent_radius(const Section &s) { // over that of the specimen
  return std::sqrt(s.fraction());
}
Line flank(const std::vector<Section> &bins, std::size_t from, std::size_t to) {
  return line_through(bins, from, to, equivalent_radius, [](const Section &) { return 1.0; });
}

// Bins [from, to) of a flank up to the tip. Of the bins that the rim cuts it contains only the last one, or
// more if there would be fewer than three bins.
struct Span {
  std::size_t from = 0, to = 0, cut_by_rim = 0; // the last: number of bins that the rim cuts
};
Span span_of_flank(const std::vector<Section> &bins, double tip) {
  Span s;
  while (s.to < bins.size() && equivalent_radius(bins[s.to]) >= tip)
    ++s.to;
  while (s.cut_by_rim < s.to && equivalent_radius(bins[s.cut_by_rim]) > full)
    ++s.cut_by_rim;
  s.from = s.cut_by_rim > 0 ? std::min(s.cut_by_rim - 1, s.to - std::min(s.to, least_bins)) : 0;
  return s;
}

// Slope of the lower half over that of the upper; the halves have one bin in common, or two if n is even.
double straightness(const std::vector<Section> &bins, const Span &span) {
  const auto [from, to, cut_by_rim] = span;
  const std::size_t n = to - from;
  const double lower = -flank(bins, from, from + n / 2 + 1).slope,
               upper = -flank(bins, from + (n - 1) / 2, to).slope;
  return upper > 0 ? std::clamp(lower / upper, 0.0, 1.0) : 1; // the overlap judges a thin top
}

double roundness(const std::vector<Section> &bins, std::size_t from, std::size_t to) {
  double sum = 0, weight = 0;
  for (std::size_t k = from; k < to; ++k) {
    if (equivalent_radius(bins[k]) > full) continue;
    sum += bins[k].volume * bins[k].roundness(), weight += bins[k].volume;
  }
  return weight > 0 ? sum / weight : 0;
}

double overlap(const std::vector<LabelledPoint> &points, const Cone &cone, double highest) {
  double both = 0, either = 0;
  for (const LabelledPoint &p : points) {
    if (p.x.z > highest) continue;
    const bool in_cone = cone.distance(p.x) < 0;
    if (in_cone && p.inside) both += p.weight;
    if (in_cone || p.inside) either += p.weight;
  }
  return either > 0 ? both / either : 0;
}

Cone cone_through(const std::vector<Section> &bins, std::size_t from, std::size_t to, double width) {
  const Line radius = flank(bins, from, to);
  const auto volume = [](const Section &s) { return s.volume; };
  const Line x = line_through(
                 bins, from, to, [](const Section &s) { return s.x; }, volume),
             y = line_through(
                 bins, from, to, [](const Section &s) { return s.y; }, volume);
  Cone c;
  c.half_angle = std::atan(-radius.slope * width);
  const double depth = -radius.at_zero / radius.slope;
  c.apex = {x.at_zero + depth * x.slope, y.at_zero + depth * y.slope, depth};
  const Vector3 up{x.slope, y.slope, 1};
  c.axis = -1 / norm(up) * up;
  return c;
}

DeadZoneVerdict judge(const DeadZone &d, double width, const DeadZoneRules &rules) {
  if (d.half_angle < rules.least_angle || d.half_angle > rules.largest_angle)
    return DeadZoneVerdict::does_not_narrow;
  if (d.tilt > rules.largest_tilt || std::hypot(d.apex.x, d.apex.y) > rules.largest_offset * width)
    return DeadZoneVerdict::leans;
  if (d.roundness < rules.least_roundness) return DeadZoneVerdict::wedge;
  if (d.overlap < rules.least_overlap) return DeadZoneVerdict::ragged;
  if (!(d.base_ratio > rules.sure_base)) return DeadZoneVerdict::doubtful;
  return d.straightness < rules.least_straightness ? DeadZoneVerdict::dome : DeadZoneVerdict::cone;
}

} // namespace

DeadZone measure_dead_zone(const Specimen &before, const std::vector<char> &members, End end,
                           const DeadZoneRules &rules) {
  DeadZone d;
  const double width = std::sqrt(before.shape.cross_section() / pi), thickness = rules.bin * width;
  const std::vector<LabelledPoint> points = seen_from(before, members, end);
  const std::vector<Section> bins = sections(points, before.shape.height, thickness);
  double dead = 0, all = 0;
  for (const Section &s : bins)
    dead += s.volume, all += s.all;
  d.spheres = static_cast<double>(std::count(members.begin(), members.end(), 1));
  d.volume_fraction = dead / all;
  d.base_ratio = equivalent_radius(bins.front());
  d.verdict = DeadZoneVerdict::nothing;
  if (d.spheres == 0) return d;

  const auto [from, to, cut_by_rim] = span_of_flank(bins, rules.tip);
  const double highest = static_cast<double>(to) * thickness;
  d.height = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].inside && points[i].x.z < highest)
      d.height = std::max(d.height, points[i].x.z + before.radius[i]);
  d.verdict = DeadZoneVerdict::small_base;
  if (d.base_ratio < rules.least_base) return d;
  d.verdict = DeadZoneVerdict::low;
  if (to < least_bins) return d;
  const std::vector<Section> fine = sections(points, before.shape.height, 0.5 * thickness);
  const Cone cone = cone_through(bins, from, to, width);
  d.half_angle = cone.half_angle;
  d.apex = cone.apex, d.axis = cone.axis, d.apex_depth = cone.apex.z;
  d.tilt = std::acos(std::clamp(-cone.axis.z, -1.0, 1.0));
  d.roundness = roundness(bins, from, to);
  d.straightness = to - from < few_bins ? straightness(fine, span_of_flank(fine, rules.tip))
                                        : straightness(bins, {from, to, cut_by_rim});
  d.overlap = overlap(points, cone, highest);
  d.confidence = d.roundness * d.straightness * d.overlap;
  d.verdict = judge(d, width, rules);
  if (2 * cut_by_rim > to) d.verdict = DeadZoneVerdict::blunt;
  if (d.volume_fraction >= rules.largest_volume) d.verdict = DeadZoneVerdict::large;
  if (end == top_end) {
    d.apex.z = before.shape.height - d.apex.z;
    d.axis.z = -d.axis.z;
  }
  return d;
}

} // namespace platen::dem
