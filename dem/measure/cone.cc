#include "dem/measure/cone.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/pi.h"
#include "dem/measure/cone_fit.h"
#include "dem/measure/gauge.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

constexpr double narrowest = 2;   // equivalent radius of the last slice that is measured, mean radii
constexpr double full = 0.9;      // share of a section from which the rim cuts the flank
constexpr double flank_reach = 3; // mean radii to both sides
constexpr int sectors = 12;
constexpr int skin_bonds = 2, skin_layers = 2;
constexpr double usual_angle = 0.5; // rad, where slices are too few to begin from

// The piece seen from its platen: z upwards from the end plane.
struct Seen {
  std::vector<LabelledPoint> points; // of all spheres that ever had a bond; inside: piece and skin
  std::vector<double> radius;        // m
  double mean_radius = 0;            // m
  double width = 0;                  // m, radius of a circle as large as the specimen's section
  double height = 0;                 // m, of the piece
  int spheres = 0;
};

// Whether a sphere is of the piece or its skin.
std::vector<char> with_skin(const Bonds &b, const SoundPieces &pieces, int piece) {
  const std::size_t n = pieces.of_particle.size();
  std::vector<char> inside(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    inside[i] = pieces.of_particle[i] == piece;
  for (int layer = 0; layer < skin_layers; ++layer) {
    std::vector<int> held(n, 0);
    for (std::size_t k = 0; k < b.size(); ++k)
      if (!b.has_failed(k)) held[b.first[k]] += inside[b.second[k]], held[b.second[k]] += inside[b.first[k]];
    for (std::size_t i = 0; i < n; ++i)
      if (held[i] >= skin_bonds && pieces.of_particle[i] == SoundPieces::none) inside[i] = 1;
  }
  return inside;
}

Seen see(const Particles &p, const std::vector<char> &bonded, const std::vector<char> &piece,
         const Shape &shape, End end) {
  Seen s;
  s.width = std::sqrt(shape.cross_section() / pi);
  s.mean_radius = mean_radius(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!bonded[i]) continue;
    Vector3 x = p.reference_position[i];
    if (end == top_end) x.z = shape.height - x.z;
    const double r = p.radius[i];
    const bool inside = piece[i];
    s.points.push_back({x, sphere_volume(r), inside});
    s.radius.push_back(r);
    if (!inside) continue;
    ++s.spheres;
    s.height = std::max(s.height, x.z + r);
  }
  return s;
}

// Volume of a sphere below the plane z.
double volume_below(double z, double centre, double radius) {
  const double h = std::clamp(z - centre + radius, 0.0, 2 * radius);
  return pi / 3 * h * h * (3 * radius - h);
}

// The piece's share of the spheres' volume in slices one mean diameter high, from the platen up.
std::vector<double> section_shares(const Seen &s) {
  const double thick = 2 * s.mean_radius;
  const std::size_t slices = static_cast<std::size_t>(std::ceil(s.height / thick));
  std::vector<double> piece(slices, 0.0), all(slices, 0.0);
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    const double z = s.points[i].x.z, r = s.radius[i];
    for (std::size_t k = static_cast<std::size_t>(std::max(0.0, (z - r) / thick));
         k < slices && static_cast<double>(k) * thick < z + r; ++k) {
      const double low = static_cast<double>(k) * thick,
                   v = volume_below(low + thick, z, r) - volume_below(low, z, r);
      all[k] += v;
      if (s.points[i].inside) piece[k] += v;
    }
  }
  for (std::size_t k = 0; k < slices; ++k)
    piece[k] = all[k] > 0 ? piece[k] / all[k] : 0;
  return piece;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Where fit_cone begins: upright, on the piece's own axis, as steep as equivalent radii say.
Cone first_guess(const Seen &s, const std::vector<double> &shares, std::size_t slices) {
  const double thick = 2 * s.mean_radius;
  std::vector<double> height, radius, slopes, tips;
  for (std::size_t k = 0; k < slices; ++k) {
    if (shares[k] > full) continue;
    height.push_back((static_cast<double>(k) + 0.5) * thick);
    radius.push_back(s.width * std::sqrt(shares[k]));
    for (std::size_t j = 0; j + 1 < height.size(); ++j)
      slopes.push_back((radius[j] - radius.back()) / (height.back() - height[j]));
  }
  const double slope = slopes.empty() ? std::tan(usual_angle) : std::max(0.05, median(slopes));
  for (std::size_t j = 0; j < height.size(); ++j)
    tips.push_back(height[j] + radius[j] / slope);
  Cone c;
  double weight = 0;
  for (const LabelledPoint &p : s.points)
    if (p.inside) c.apex += p.weight * p.x, weight += p.weight;
  c.apex *= 1 / weight;
  c.apex.z = tips.empty() ? s.height : median(tips);
  c.half_angle = std::atan(slope);
  return c;
}

double overlap(const std::vector<LabelledPoint> &points, const Cone &c) {
  double both = 0, either = 0;
  for (const LabelledPoint &p : points) {
    const bool in_cone = c.distance(p.x) < 0;
    if (in_cone && p.inside) both += p.weight;
    if (in_cone || p.inside) either += p.weight;
  }
  return either > 0 ? both / either : 0;
}

double roundness(const std::vector<LabelledPoint> &points, const Cone &c, double reach) {
  struct Sector {
    double inside = 0, outside = 0, right = 0;
  };
  std::array<Sector, sectors> around;
  for (const LabelledPoint &p : points) {
    const double d = c.distance(p.x);
    if (std::abs(d) > reach) continue;
    const Vector3 w = p.x - c.apex;
    const Vector3 across = w - dot(w, c.axis) * c.axis;
    const double turn = (std::atan2(across.y, across.x) / pi + 1) / 2;
    Sector &s = around[static_cast<std::size_t>(std::min(sectors - 1, static_cast<int>(sectors * turn)))];
    (p.inside ? s.inside : s.outside) += p.weight;
    if (p.inside == (d < 0)) s.right += p.weight;
  }
  // One side of a flank alone is no flank: the rim, or a crushed end.
  const auto good = std::count_if(around.begin(), around.end(), [](const Sector &s) {
    const double all = s.inside + s.outside;
    return std::min(s.inside, s.outside) > 0.1 * all && s.right > 0.6 * all;
  });
  return static_cast<double>(good) / sectors;
}

NoCone judge(const ConePiece &c, const Vector3 &apex, double width, const ConeRules &rules) {
  if (c.half_angle < rules.least_angle || c.half_angle > rules.largest_angle) return NoCone::does_not_narrow;
  if (c.tilt > rules.largest_tilt || std::hypot(apex.x, apex.y) > rules.largest_offset * width)
    return NoCone::leans;
  if (c.roundness < rules.least_roundness) return NoCone::one_sided;
  if (c.overlap < rules.least_overlap) return NoCone::ragged;
  return NoCone::found;
}

ConePiece measure(const Seen &s, const ConeRules &rules) {
  ConePiece c;
  c.spheres = s.spheres;
  c.height = s.height;
  c.verdict = NoCone::few_spheres;
  if (s.spheres < rules.least_spheres) return c;
  c.verdict = NoCone::thin;
  if (s.height < rules.least_height * s.mean_radius) return c;

  const std::vector<double> shares = section_shares(s);
  std::size_t slices = shares.size(), whole = 0;
  while (slices > 0 && s.width * std::sqrt(shares[slices - 1]) < narrowest * s.mean_radius)
    --slices;
  while (whole < slices && shares[whole] > full)
    ++whole;
  const double thick = 2 * s.mean_radius;
  c.verdict = NoCone::blunt;
  if (slices < 2 || static_cast<double>(whole) * thick > 0.5 * s.height) return c;

  // The last slice may be the half of a cut.
  std::vector<LabelledPoint> zone;
  for (const LabelledPoint &p : s.points)
    if (p.x.z < static_cast<double>(slices - 1) * thick) zone.push_back(p);
  const Cone cone = fit_cone(zone, first_guess(s, shares, slices), {thick, s.mean_radius, s.width});
  c.half_angle = cone.half_angle;
  c.apex_depth = cone.apex.z;
  c.apex = cone.apex;
  c.axis = cone.axis;
  c.tilt = std::acos(std::clamp(-cone.axis.z, -1.0, 1.0));
  c.overlap = overlap(zone, cone);
  c.roundness = roundness(zone, cone, flank_reach * s.mean_radius);
  c.confidence = c.overlap * c.roundness;
  c.verdict = judge(c, cone.apex, s.width, rules);
  return c;
}

} // namespace

const char *words_of(NoCone why) {
  constexpr const char *words[] = {"not measured",
                                   "a cone",
                                   "no sound piece stands on the platen",
                                   "the sound piece goes on to the other platen",
                                   "the sound piece has too few spheres",
                                   "the sound piece is a thin layer",
                                   "the sound piece has the full section over half of its height",
                                   "the sound piece does not narrow as a cone does",
                                   "the sound piece leans to one side",
                                   "the sound piece has no flank all around",
                                   "the sound piece is too ragged for a cone"};
  return words[static_cast<int>(why)];
}

std::array<ConePiece, 2> measure_cones(const Particles &p, const Bonds &b, const SoundPieces &pieces,
                                       const Shape &shape, const ConeRules &rules) {
  std::array<ConePiece, 2> cones;
  if (shape.kind == ShapeKind::disc) return cones;
  const std::vector<char> bonded = ever_bonded(p, &b);
  for (const End end : {bottom_end, top_end}) {
    ConePiece &cone = cones[end];
    const int piece = pieces.at_end[end];
    cone.verdict = NoCone::nothing_stands;
    if (piece == SoundPieces::none) continue;
    if (!pieces.spans(piece))
      cone = measure(see(p, bonded, with_skin(b, pieces, piece), shape, end), rules);
    else
      cone.verdict = NoCone::spans;
    cone.volume_fraction = pieces.share(piece);
    if (end == bottom_end) continue;
    cone.apex.z = shape.height - cone.apex.z;
    cone.axis.z = -cone.axis.z;
  }
  return cones;
}

void ConePiece::describe(Archive &archive) {
  archive.version(1);
  archive("verdict", verdict, "1", between(0, static_cast<double>(NoCone::ragged)));
  archive("spheres", spheres, "1", any_value());
  archive("height", height, "m", any_value());
  archive("half_angle", half_angle, "rad", any_value());
  archive("volume_fraction", volume_fraction, "1", any_value());
  archive("apex_depth", apex_depth, "m", any_value());
  archive("tilt", tilt, "rad", any_value());
  archive("apex", apex, "m", any_value());
  archive("axis", axis, "1", any_value());
  archive("overlap", overlap, "1", any_value());
  archive("roundness", roundness, "1", any_value());
  archive("confidence", confidence, "1", any_value());
}

} // namespace platen::dem
