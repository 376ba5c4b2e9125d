#include "apps/run/pack.h"

#include <fmt/format.h>

#include <numeric>
#include <string>
#include <vector>

#include "apps/output/csv_writer.h"
#include "apps/output/machine.h"
#include "apps/output/specimen_csv.h"
#include "apps/output/vtu.h"
#include "apps/run/app_output.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/version.h"
#include "base/parallel.h"
#include "dem/packing/quality.h"
#include "dem/packing/specimen.h"

namespace platen::apps {
namespace {

// Gaps, in mean radii, at which coordination is counted: touching spheres of an advancing front, of a jammed
// packing, and neighbours that a bond of that gap would reach.
constexpr double tolerances[] = {1e-4, 1e-3, 0.05, 0.1};

struct Judgement {
  dem::PackingQuality quality; // at 1e-3 mean radii
  std::vector<double> coordination;
  std::size_t seated_bottom = 0, seated_top = 0; // as the scene prepares the ends
  double grain_density = 0;                      // kg/m3
};

Judgement judge(const dem::Specimen &specimen, const Scene &scene) {
  Judgement j;
  j.quality = dem::judge_packing(specimen);
  for (const double tolerance : tolerances)
    j.coordination.push_back(
        2.0 * static_cast<double>(dem::touching_pairs(specimen, tolerance * j.quality.mean_radius).size()) /
        static_cast<double>(specimen.size()));
  const dem::SpecimenEnds ends = dem::seat_ends(specimen, scene.specimen.ends, scene.specimen.end_layer);
  j.seated_bottom = ends.bottom.particle.size();
  j.seated_top = ends.top.particle.size();
  j.grain_density = dem::grain_density(specimen, scene.model.density, scene.model.density_of);
  return j;
}

Json summary_of(const Scene &scene, const Judgement &j, const Tiling &tiling, double seconds) {
  const dem::PackingQuality &q = j.quality;
  Json s;
  s["status"] = "done";
  s["app"] = "platen-pack";
  s["scene"] = title_of(scene);
  s["version"] = version_line();
  s["particles"] = q.spheres;
  s["mean_radius_m"] = q.mean_radius;
  s["packing_fraction"] = q.packing_fraction;
  s["core_packing_fraction"] = q.core_packing_fraction;
  s["grain_density_kg_m3"] = j.grain_density;
  s["coordination_number"] = q.coordination_number;
  s["core_coordination_number"] = q.core_coordination_number;
  for (std::size_t k = 0; k < j.coordination.size(); ++k)
    s[fmt::format("coordination_number_at_gap_{}", tolerances[k])] = j.coordination[k];
  s["rattlers"] = q.rattlers;
  s["max_overlap_over_radius"] = q.max_overlap;
  s["mean_overlap_over_radius"] = q.mean_overlap;
  s["max_wall_overlap_over_radius"] = q.max_wall_overlap;
  s["isotropy_chi_squared"] = q.isotropy_chi_squared;
  s["touching_bottom"] = q.touching_bottom;
  s["touching_top"] = q.touching_top;
  s["seated_bottom"] = j.seated_bottom;
  s["seated_top"] = j.seated_top;
  if (tiling.tiles > 0) {
    s["tiles"] = tiling.tiles;
    s["tile_period_m"] = tiling.period;
  }
  s["wall_seconds"] = seconds;
  s["peak_memory_bytes"] = peak_memory_bytes();
  return s;
}

// Where the contacts point: a row for each pair of opposite cells of the sphere.
void write_directions(const OutputPaths &paths, const std::vector<dem::AxisCell> &cells) {
  std::size_t contacts = 0;
  for (const dem::AxisCell &cell : cells)
    contacts += cell.axes;
  WholeTable table(paths.directions(),
                   {"x", "y", "z", "share_of_directions", "contacts", "share_of_contacts"});
  for (const dem::AxisCell &cell : cells)
    table.row({cell.middle.x, cell.middle.y, cell.middle.z, cell.weight, cell.axes,
               static_cast<double>(cell.axes) / static_cast<double>(contacts)});
  table.finish();
}

std::string report_of(const Judgement &j, const Tiling &tiling, double seconds) {
  const dem::PackingQuality &q = j.quality;
  std::string text = fmt::format("  spheres                    {} of mean radius {:.4g} mm\n", q.spheres,
                                 1e3 * q.mean_radius);
  text += fmt::format("  packing fraction           {:.4f}, core {:.4f}\n", q.packing_fraction,
                      q.core_packing_fraction);
  text += "  coordination number       ";
  for (std::size_t k = 0; k < j.coordination.size(); ++k)
    text += fmt::format(" {:.2f} at {} R{}", j.coordination[k], tolerances[k],
                        k + 1 < j.coordination.size() ? "," : "\n");
  text += fmt::format("  core coordination number   {:.2f} at 0.001 R\n", q.core_coordination_number);
  text += fmt::format("  overlap over radius        mean {:.1e}, largest {:.1e}\n", q.mean_overlap,
                      q.max_overlap);
  text +=
      fmt::format("  isotropy, chi squared      {:.2f} (isotropic: 1.0 +- 0.1)\n", q.isotropy_chi_squared);
  text += fmt::format("  at the ends                touching {} and {}, seated {} and {}\n",
                      q.touching_bottom, q.touching_top, j.seated_bottom, j.seated_top);
  text += text_of(tiling);
  text += fmt::format("  seconds                    {:.1f}\n", seconds);
  return text;
}

} // namespace

int run_pack(const CommandLine &command, const Scene &scene) {
  if (command.resume)
    throw InputError("command line: --resume: a packing has nothing to resume; leave it out");
  AppOutput output(command, scene);
  if (command.dry_run) {
    require_room(scene);
    const dem::Shape shape = specimen_shape(scene);
    fmt::print("{}\n  volume {:.4g} cm3, sphere radius {:.4g} mm\n{}", title_of(scene), 1e6 * shape.volume(),
               1e3 * scene.specimen.sphere_radius, text_of(tiling_of(scene, shape)));
    return status_done;
  }
  const auto start = Clock::now();
  const dem::Specimen specimen = make_specimen(scene);
  const double seconds = seconds_since(start);
  const Judgement judgement = judge(specimen, scene);

  const Tiling tiling = tiling_of(scene, specimen.shape);
  output.open(scene.specimen.packing == PackingKind::random_close ? loop_threads() : 1);
  const OutputPaths &paths = output.paths;
  write_specimen_csv(paths.specimen_csv(), specimen);
  for (const SpecimenFormat format : scene.specimen.exports)
    write_specimen_as(format, paths.folder, specimen, judgement.grain_density);
  std::vector<int> id(specimen.size());
  std::iota(id.begin(), id.end(), 0);
  write_points(paths.specimen_vtu(), 0.0, specimen.centre, {{"radius", specimen.radius}, {"id", id}});
  write_directions(paths, judgement.quality.directions);
  return output.finish(
      summary_of(scene, judgement, tiling, seconds),
      fmt::format("{}\nresults are in {}", report_of(judgement, tiling, seconds), paths.folder.string()));
}

} // namespace platen::apps
