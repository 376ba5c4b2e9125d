// What packings of any size cost, and how good they are: overall, in slabs from the wall inwards, and in
// slabs across the axis. Results stand in results/packing.md.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "apps/output/machine.h"
#include "apps/output/specimen_csv.h"
#include "arguments.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "base/pi.h"
#include "dem/packing/advancing_front.h"
#include "dem/packing/growth.h"
#include "dem/packing/quality.h"
#include "dem/packing/tiled.h"

namespace {

using namespace platen;

struct Options {
  std::string kind = "grown", shape = "box";
  int spheres = 22500, tile = 50000, threads = 1, seed = 1;
  double spread = 0, at_rest = 1e-2;
  bool slabs = false;
  std::string write;
};

constexpr double radius = 1e-3; // m, mean
// Overall packing fractions that a large specimen reaches, with its walls.
constexpr double close_fraction = 0.63, front_fraction = 0.54;

// A cube, or a cylinder twice as high as wide.
dem::Shape shape_for(const Options &o) {
  const double fraction = o.kind == "front" ? front_fraction : close_fraction;
  const double volume = static_cast<double>(o.spheres) * dem::sphere_volume(radius) *
                        (1 + 0.25 * o.spread * o.spread) / fraction;
  if (o.shape == "box") {
    const double edge = std::cbrt(volume);
    return dem::box(edge, edge, edge);
  }
  const double r = std::cbrt(volume / (4 * pi));
  return dem::cylinder(r, 4 * r);
}

dem::Specimen packed(const Options &o, const dem::Shape &shape) {
  const std::uint64_t seed = static_cast<std::uint64_t>(o.seed);
  const std::size_t spheres = static_cast<std::size_t>(o.spheres), tile = static_cast<std::size_t>(o.tile);
  if (o.kind == "front")
    return dem::advancing_front(shape, dem::uniform_radii_of_spread(radius, o.spread), seed);
  if (o.kind == "grown") {
    dem::GrowthReport made;
    dem::Specimen specimen = dem::random_close_packing_of(shape, spheres, o.spread, seed, &made);
    std::printf("%ld iterations, %d stages\n", made.iterations, made.stages);
    return specimen;
  }
  dem::TilingReport made;
  dem::Specimen specimen = dem::tiled_close_packing(shape, radius, o.spread, tile, seed, &made, o.at_rest);
  std::printf("%.2f tiles of %zu (fraction %.4f, %ld iterations), period %.2f R; %ld iterations, %d stages\n",
              made.tiles, made.tile.spheres, made.tile.packing_fraction, made.tile.iterations,
              made.period / radius, made.specimen.iterations, made.specimen.stages);
  return specimen;
}

// Fowler, Noll and Vo's sum of all bytes of places and radii.
std::uint64_t sum_of(const dem::Specimen &s) {
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  const auto add = [&](double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof x);
    sum = (sum ^ bits) * 0x100000001b3ULL;
  };
  for (std::size_t i = 0; i < s.size(); ++i)
    add(s.centre[i].x), add(s.centre[i].y), add(s.centre[i].z), add(s.radius[i]);
  return sum;
}

dem::Shape moved_in(dem::Shape shape, double margin) {
  shape.height -= 2 * margin;
  if (shape.kind == dem::ShapeKind::cylinder) shape.radius -= margin;
  if (shape.kind == dem::ShapeKind::box) shape.width_x -= 2 * margin, shape.width_y -= 2 * margin;
  return shape;
}

struct Slab {
  double centres = 0, ends_of_contacts = 0, neighbours = 0, volume = 0, axes = 0;
  std::array<double, 3> fabric{}; // sums of n_k^2
};

void print(const char *what, double from, double to, const Slab &s, double whole) {
  std::printf(
      "%s %6.2f ... %6.2f R: %8.0f spheres, fraction %.4f, %.3f contacts, %.3f within .1 R, fabric "
      "%.4f %.4f %.4f\n",
      what, from, to, s.centres, s.volume / whole, s.ends_of_contacts / s.centres, s.neighbours / s.centres,
      s.fabric[0] / s.axes, s.fabric[1] / s.axes, s.fabric[2] / s.axes);
}

// Slabs between `edges`: of the clearance from the walls, or of the height in what is 6 R from the walls.
void print_slabs(const dem::Specimen &s, double mean, bool along_z, const std::vector<double> &edges) {
  constexpr double margin = 6;
  const dem::Shape inside = moved_in(s.shape, margin * mean);
  const auto place = [&](const Vector3 &p) {
    if (!along_z) return dem::wall_clearance(s.shape, p) / mean;
    const double in = dem::wall_clearance(s.shape, p) / mean;
    return in < margin ? -1.0 : p.z / mean;
  };
  const auto slab_of = [&](const Vector3 &p) {
    const double at = place(p);
    for (std::size_t k = 0; k + 1 < edges.size(); ++k)
      if (at >= edges[k] && at < edges[k + 1]) return k;
    return edges.size();
  };
  std::vector<Slab> slab(edges.size() + 1);
  for (std::size_t i = 0; i < s.size(); ++i)
    ++slab[slab_of(s.centre[i])].centres;
  for (const dem::TouchingPair &p : dem::touching_pairs(s, 0.1 * mean)) {
    const Vector3 &a = s.centre[static_cast<std::size_t>(p.first)],
                  &b = s.centre[static_cast<std::size_t>(p.second)];
    ++slab[slab_of(a)].neighbours, ++slab[slab_of(b)].neighbours;
    if (p.gap > 1e-3 * mean) continue;
    ++slab[slab_of(a)].ends_of_contacts, ++slab[slab_of(b)].ends_of_contacts;
    Slab &middle = slab[slab_of(0.5 * (a + b))];
    ++middle.axes;
    for (int k = 0; k < 3; ++k)
      middle.fabric[static_cast<std::size_t>(k)] += (b - a)[k] * (b - a)[k] / norm_squared(b - a);
  }
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const auto part = [&](std::size_t i, double edge) {
      dem::Shape cut = along_z ? inside : moved_in(s.shape, edge * mean);
      const double low = along_z ? margin * mean : edge * mean;
      if (along_z) cut.height = edge * mean - low;
      return cut.height > 0 ? dem::clipped_volume(s.centre[i] - Vector3{0, 0, low}, s.radius[i], cut) : 0.0;
    };
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double at = (along_z ? s.centre[i].z : dem::wall_clearance(s.shape, s.centre[i])) / mean;
      if (at < edges[k] - 2 || at > edges[k + 1] + 2) continue;
      slab[k].volume += std::abs(part(i, edges[k + 1]) - part(i, edges[k]));
    }
    const double whole = along_z ? inside.cross_section() * (edges[k + 1] - edges[k]) * mean
                                 : moved_in(s.shape, edges[k] * mean).volume() -
                                       moved_in(s.shape, edges[k + 1] * mean).volume();
    print(along_z ? "height" : "depth ", edges[k], edges[k + 1], slab[k], whole);
  }
}

void judge(const dem::Specimen &s, const Options &o) {
  const dem::PackingQuality q = dem::judge_packing(s);
  std::printf("fraction %.4f, core %.4f; contacts at .001 R %.3f, core %.3f; rattlers %.2f %%\n",
              q.packing_fraction, q.core_packing_fraction, q.coordination_number, q.core_coordination_number,
              100.0 * static_cast<double>(q.rattlers) / static_cast<double>(q.spheres));
  std::printf("neighbours within .1 R %.3f; overlap mean %.1e, largest %.1e, of walls %.1e\n",
              2.0 * static_cast<double>(dem::touching_pairs(s, 0.1 * q.mean_radius).size()) /
                  static_cast<double>(s.size()),
              q.mean_overlap, q.max_overlap, q.max_wall_overlap);
  std::printf(
      "chi squared %.2f; ends touched by %zu and %zu, cover %.3f and %.3f; radii %.4f ... %.4f, mean %.5f "
      "mm\n",
      q.isotropy_chi_squared, q.touching_bottom, q.touching_top, q.cover_bottom, q.cover_top,
      1e3 * dem::smallest_radius(s), 1e3 * dem::largest_radius(s), 1e3 * q.mean_radius);
  if (!o.slabs) return;
  print_slabs(s, q.mean_radius, false, {0, 2, 4, 6, 8, 10, 12, 15, 20, 30});
  // Ten equal slabs of height, as near to the period of a tile as the height allows.
  std::vector<double> edges;
  const double height = s.shape.height / q.mean_radius - 12;
  for (int k = 0; k <= 12; ++k)
    edges.push_back(6 + height * k / 12);
  print_slabs(s, q.mean_radius, true, edges);
}

} // namespace

int main(int argc, char **argv) {
  Options o;
  bench::read_arguments(
      argc, argv, "Seconds and quality of packings.",
      {{"--kind", &o.kind, "how they are made", 0, 0, {"front", "grown", "tiled"}},
       {"--shape", &o.shape, "of the specimen", 0, 0, {"box", "cylinder"}},
       {"--spheres", &o.spheres, "about so many, of 1 mm radius", 100, 1e8},
       {"--tile", &o.tile, "spheres of a tile", 200, 5e6},
       {"--threads", &o.threads, "threads", 1, 256},
       {"--seed", &o.seed, "seed", 0, 1e6},
       {"--spread", &o.spread, "of the radii", 0, 1.5},
       {"--at-rest", &o.at_rest, "residual force at which a stage of tiles ends", 1e-4, 0.1},
       {"--slabs", &o.slabs, "quality in slabs too"},
       {"--write-specimen", &o.write, "write the packing to this file"}});

  const ThreadLimit limit(o.threads);
  const auto start = Clock::now();
  const dem::Specimen specimen = packed(o, shape_for(o));
  const double seconds = seconds_since(start);
  std::printf("%zu spheres in %.4g s on %d threads; %.0f bytes a sphere at most; sum %016llx\n",
              specimen.size(), seconds, o.threads,
              static_cast<double>(apps::peak_memory_bytes()) / static_cast<double>(specimen.size()),
              static_cast<unsigned long long>(sum_of(specimen)));
  std::fflush(stdout);
  if (!o.write.empty()) apps::write_specimen_csv(o.write, specimen);
  judge(specimen, o);
  return 0;
}
