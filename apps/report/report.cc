#include "apps/report/report.h"

#include <algorithm>
#include <ostream>

#include "apps/report/comparison.h"
#include "apps/report/html_page.h"
#include "apps/report/pictures.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// Adds a picture to the list; returns where it is to be written.
fs::path next(std::vector<Picture> &pictures, const fs::path &folder, const char *name,
              const std::string &caption) {
  pictures.push_back({folder / name, caption});
  return pictures.back().file;
}

void draw_comparison(const std::vector<Run> &runs, const fs::path &folder, std::vector<Picture> &drawn) {
  draw_stress_strain(runs, next(drawn, folder, "comparison_stress_strain.png",
                                "Stress and broken bonds against strain, all runs."));
  if (std::all_of(runs.begin(), runs.end(), [](const Run &run) { return run.specimen.empty(); })) return;
  draw_displacement_comparison(
      runs, next(drawn, folder, "comparison_displacement.png",
                 "Half specimens at the end, coloured by outward displacement: what is dark stood still."));
  draw_damage_comparison(runs,
                         next(drawn, folder, "comparison_damage.png",
                              "Half specimens coloured by the share of each sphere's bonds that is broken."));
}

void draw_ends(const Run &run, const Extent &extent, const fs::path &folder, std::vector<Picture> &drawn) {
  if (run.contacts.empty() || extent.form != Extent::Form::cylinder) return;
  draw_platen_profiles(run, extent,
                       next(drawn, folder, "platen_pressure.png",
                            "Pressure on the platens and shear on the ends over the radius, near the peak."));
  draw_stick_and_slip(run, extent,
                      next(drawn, folder, "stick_slip.png",
                           "Spheres at the platens near the peak: which stick and which slide."));
}

void draw_one_run(const Run &run, const fs::path &folder, std::vector<Picture> &drawn) {
  draw_stress_strain({run},
                     next(drawn, folder, "stress_strain.png",
                          "Axial stress against strain between the platens and in the gauge; broken bonds."));
  draw_energies(
      run, next(drawn, folder, "energies.png", "The energy ledger: where the work of the platens went."));
  if (run.specimen.empty()) return;
  const Spheres before_test = read_spheres(run.specimen.frames.front());
  const Extent extent = extent_of(before_test);
  draw_outward_displacement(
      run, extent,
      next(drawn, folder, "outward_displacement.png", "Half specimen coloured by outward displacement."));
  draw_damage(run, extent,
              next(drawn, folder, "damage.png",
                   "Half specimen coloured by the share of each sphere's bonds that is broken."));
  if (!before_test.fragment.empty())
    draw_fragments(run, extent, next(drawn, folder, "fragments.png", fragments_caption(run)));
  draw_ends(run, extent, folder, drawn);
  if (!run.cracks) return;
  draw_cracks(
      run, before_test,
      next(drawn, folder, "cracks.png", "Broken bonds as discs, in tension (left) and in shear (right)."));
  draw_crack_density(
      run, before_test,
      next(drawn, folder, "crack_density.png",
           extent.is_plane()
               ? "Broken bonds over height and distance from the middle plane; the left half mirrors the "
                 "right."
               : "Broken bonds over height and distance from the axis; the left half mirrors the right."));
}

} // namespace

void write_report(const std::vector<Run> &runs, const fs::path &folder, std::ostream &out) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be made: " + error.message());
  for (const Run &run : runs)
    for (const std::string &remark : run.remarks)
      out << run.name << ": " << remark << '\n';

  std::vector<Picture> drawn;
  if (runs.size() > 1) draw_comparison(runs, folder, drawn);
  draw_one_run(runs.front(), folder, drawn);
  const TableOfFigures figures = table_of_figures(runs);
  write_html(runs, figures, drawn, folder / "report.html");
  for (const Picture &picture : drawn)
    out << "drawn: " << picture.file.string() << '\n';
  out << "page: " << (folder / "report.html").string() << "\n\n" << as_text(figures);
}

} // namespace platen::apps::report
