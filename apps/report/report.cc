#include "apps/report/report.h"

#include <ostream>

#include "apps/report/canvas.h"
#include "apps/report/comparison.h"
#include "apps/report/pictures.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

void draw_one_run(const Run &run, const fs::path &pictures, std::vector<fs::path> &drawn) {
  const auto next = [&](const char *name) { return drawn.emplace_back(pictures / name); };
  draw_stress_strain({run}, next("stress_strain.png"));
  draw_energies(run, next("energies.png"));
  if (run.specimen.empty()) return;
  const Spheres before_test = read_spheres(run.specimen.frames.front());
  const Extent extent = extent_of(before_test);
  draw_outward_displacement(run, extent, next("outward_displacement.png"));
  draw_damage(run, extent, next("damage.png"));
  if (!run.cracks) return;
  draw_cracks(run, before_test, next("cracks.png"));
  draw_crack_density(run, before_test, next("crack_density.png"));
}

void draw_comparison(const std::vector<Run> &runs, const fs::path &pictures, std::vector<fs::path> &drawn) {
  draw_stress_strain(runs, drawn.emplace_back(pictures / "comparison_stress_strain.png"));
  std::size_t with_frames = 0;
  for (const Run &run : runs)
    with_frames += run.specimen.empty() ? 0 : 1;
  if (with_frames > 0) draw_damage_comparison(runs, drawn.emplace_back(pictures / "comparison_damage.png"));
}

} // namespace

void write_report(const std::vector<Run> &runs, const fs::path &pictures, std::ostream &out) {
  std::error_code error;
  fs::create_directories(pictures, error);
  if (error) throw OutputError(pictures.string() + ": cannot be made: " + error.message());
  for (const Run &run : runs)
    for (const std::string &remark : run.remarks)
      out << run.name << ": " << remark << '\n';

  std::vector<fs::path> drawn;
  draw_one_run(runs.front(), pictures, drawn);
  if (runs.size() > 1) draw_comparison(runs, pictures, drawn);
  for (const fs::path &picture : drawn)
    out << "drawn: " << picture.string() << '\n';
  out << '\n' << as_text(table_of_figures(runs));
}

} // namespace platen::apps::report
