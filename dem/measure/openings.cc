#include "dem/measure/openings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "base/largest.h"
#include "base/pi.h"
#include "dem/cell_grid.h"
#include "dem/measure/cracks.h"
#include "dem/measure/damage.h"
#include "dem/measure/fragments.h"

namespace platen::dem {
namespace {

double larger(const std::vector<double> &largest, std::size_t record, double value) {
  Largest of_both;
  of_both.add(record < largest.size() ? largest[record] : 0);
  of_both.add(value);
  return of_both.value();
}

// Whether a path along an axis goes from one flat face to the other.
bool is_crossed(const Shape &shape, int axis) {
  if (shape.kind == ShapeKind::box) return true;
  return axis == (shape.kind == ShapeKind::disc ? 1 : 2);
}

double along(const Vector3 &v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Open facets, the widest first, joined one after the other.
struct Joined {
  std::vector<Opening> facets;
  std::vector<std::vector<int>> wider; // neighbours of each that are before it
};

Joined joined_by_width(const std::vector<Opening> &openings, double reach) {
  Joined j;
  std::copy_if(openings.begin(), openings.end(), std::back_inserter(j.facets),
               [](const Opening &o) { return o.opening > 0; });
  std::stable_sort(j.facets.begin(), j.facets.end(),
                   [](const Opening &a, const Opening &b) { return a.opening > b.opening; });
  std::vector<Vector3> at;
  for (const Opening &o : j.facets)
    at.push_back(o.place);
  const std::vector<double> points(at.size(), 0.0);
  j.wider.resize(at.size());
  for (const IndexPair &pair : near_pairs(at.data(), points.data(), at.size(), reach))
    j.wider[static_cast<std::size_t>(pair.second)].push_back(pair.first);
  return j;
}

// Members of clusters that come to both ends of an axis, and the limit at which the first one does.
struct Through {
  double width = 0; // m
  std::vector<char> leads;
};

Through through_along(const Joined &joined, int axis, double low, double high) {
  const std::size_t n = joined.facets.size(), ends = n; // two more members: the faces
  DisjointSets sets(n + 2);
  Through found{0, std::vector<char>(n, 0)};
  for (std::size_t k = 0; k < n; ++k) {
    const double at = along(joined.facets[k].place, axis);
    const int one = static_cast<int>(k);
    for (const int other : joined.wider[k])
      sets.join(one, other);
    if (at < low) sets.join(one, static_cast<int>(ends));
    if (at > high) sets.join(one, static_cast<int>(ends + 1));
    if (found.width == 0 && sets.name(static_cast<int>(ends)) == sets.name(static_cast<int>(ends + 1)))
      found.width = joined.facets[k].opening;
  }
  if (found.width == 0) return found;
  for (std::size_t k = 0; k < n; ++k)
    found.leads[k] = sets.name(static_cast<int>(k)) == sets.name(static_cast<int>(ends));
  return found;
}

} // namespace

Opening opening_of(const Particles &p, const Bonds &b, std::size_t record) {
  const auto i = static_cast<std::size_t>(b.record_first[record]),
             j = static_cast<std::size_t>(b.record_second[record]);
  const Vector3 branch = p.reference_position[j] - p.reference_position[i];
  const double lever = centre_to_centre(b.law) ? 0.5 : p.radius[i] / (p.radius[i] + p.radius[j]);
  const auto turned = [&](std::size_t k, const Vector3 &v) {
    return p.has_rotation() ? rotate((*p.orientation)[k], v) : v;
  };
  const Vector3 of_first = turned(i, branch), of_second = turned(j, branch), mean = of_first + of_second,
                now = p.position[j] - p.position[i];
  Opening o;
  o.record = record;
  o.place = reference_midpoint(p, b, record);
  o.jump = now - (1 - lever) * of_second - lever * of_first;
  // Spheres that have turned against each other by half a turn have no common direction.
  o.normal = norm(mean) > 0 ? mean / norm(mean) : now / norm(now);
  o.opening = dot(o.jump, o.normal);
  o.slip = norm(o.jump - o.opening * o.normal);
  o.second_moves =
      norm(p.position[j] - p.reference_position[j]) > norm(p.position[i] - p.reference_position[i]);
  return o;
}

std::vector<Opening> openings(const Particles &p, const Bonds &b) {
  std::vector<Opening> all;
  for (std::size_t k = 0; k < b.initial_count(); ++k)
    if (is_broken(b.state[k])) all.push_back(opening_of(p, b, k));
  return all;
}

void LargestOpenings::follow(const Particles &p, const Bonds &b) {
  opening_.resize(b.initial_count(), 0.0);
  slip_.resize(b.initial_count(), 0.0);
  for (const Opening &o : openings(p, b)) {
    opening_[o.record] = opening(o);
    slip_[o.record] = slip(o);
  }
}

double LargestOpenings::opening(const Opening &now) const {
  return larger(opening_, now.record, now.opening);
}

double LargestOpenings::slip(const Opening &now) const {
  return larger(slip_, now.record, now.slip);
}

void LargestOpenings::describe(Archive &archive) {
  archive.version(1);
  archive.rows("opening", opening_, "m", at_least(0));
  archive.rows("slip", slip_, "m", at_least(0));
}

namespace {

struct Facets { // of the initial bonds
  const Particles &particles;
  const Bonds &bonds;
  const BondLayout &layout;
  std::array<std::size_t, 2> spheres(std::size_t record) const {
    return {static_cast<std::size_t>(bonds.record_first[record]),
            static_cast<std::size_t>(bonds.record_second[record])};
  }
  double section(std::size_t record) const { // m^2, of the bond
    const auto [i, j] = spheres(record);
    const double r = layout.bond_radius(particles.radius[i], particles.radius[j]);
    return pi * r * r;
  }
};

} // namespace

double area_factor(const Particles &p, const Bonds &b, const BondLayout &layout, const Shape &shape) {
  const Facets facets{p, b, layout};
  const double margin = 2 * mean_radius(p);
  Shape whole = shape, core = shape;
  whole.notch = core.notch = {};
  for (double *edge : {&core.radius, &core.width_x, &core.width_y, &core.height})
    *edge -= edge == &core.radius ? margin : 2 * margin;
  const bool has_core = smallest_width(core) > margin;
  std::vector<char> inner(p.size(), 1);
  for (std::size_t i = 0; i < p.size() && has_core; ++i)
    inner[i] = wall_clearance(whole, p.reference_position[i]) > margin;
  double sum = 0;
  for (std::size_t k = 0; k < b.initial_count(); ++k) {
    const auto [i, j] = facets.spheres(k);
    const double share = 0.5 * (inner[i] + inner[j]);
    if (share > 0) sum += share * facets.section(k) * norm(p.reference_position[j] - p.reference_position[i]);
  }
  return sum > 0 ? 3 * (has_core ? core : whole).volume() / sum : 0;
}

namespace {

// What leads through along each axis, and what flows there.
void find_ways(CrackWidths &w, const std::vector<Opening> &openings, const Particles &p, const Shape &shape,
               const std::function<double(const Opening &)> &area) {
  const double reach = CrackPlaneRules{}.reach * mean_radius(p);
  const Joined joined = joined_by_width(openings, reach);
  const BoundingBox box = bounding_box(shape);
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_crossed(shape, axis)) continue;
    const auto at = static_cast<std::size_t>(axis);
    const Through found =
        through_along(joined, axis, along(box.low, axis) + reach, along(box.high, axis) - reach);
    if (found.width > 0) w.through[at] = found.width;
    w.permeability[at] = 0;
    for (std::size_t k = 0; k < joined.facets.size(); ++k) {
      if (!found.leads[k]) continue;
      const Opening &o = joined.facets[k];
      w.permeability[at] +=
          area(o) * std::pow(o.opening, 3) * (1 - std::pow(along(o.normal, axis), 2)) / (12 * shape.volume());
    }
  }
}

} // namespace

CrackWidths crack_widths(const std::vector<Opening> &openings, const Particles &p, const Bonds &b,
                         const BondLayout &layout, const Shape &shape, double roughness) {
  const double factor = area_factor(p, b, layout, shape);
  const Facets facets{p, b, layout};
  const auto area = [&](const Opening &o) { return factor * facets.section(o.record); };
  CrackWidths w;
  Largest largest;
  double all = 0, open = 0;
  for (const Opening &o : openings) {
    const double a = area(o);
    all += a;
    largest.add(o.opening);
    for (std::size_t k = 0; k < w.wider.size(); ++k)
      if (o.opening > crack_width_limits[k]) w.wider[k] += a;
    if (!(o.opening > 0)) continue;
    ++w.open;
    open += a;
    w.volume += a * o.opening;
  }
  for (double &share : w.wider)
    share = all > 0 ? share / all : CrackWidths::none;
  if (!openings.empty() && !std::isfinite(largest.value())) { // then nothing is known of all together
    w.open = w.volume = CrackWidths::none;
    w.wider.fill(CrackWidths::none);
    return w;
  }
  if (largest.value() > 0) w.largest = largest.value();
  if (open > 0) w.mean = w.volume / open;
  find_ways(w, openings, p, shape, area);
  for (double &k : w.permeability)
    k *= roughness;
  return w;
}

} // namespace platen::dem
