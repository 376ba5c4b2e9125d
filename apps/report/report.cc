#include "apps/report/report.h"

#include <algorithm>

#include "apps/report/bars.h"
#include "apps/report/biaxial.h"
#include "apps/report/confinement.h"
#include "apps/report/cracks.h"
#include "apps/report/curves.h"
#include "apps/report/fields.h"
#include "apps/report/friction.h"
#include "apps/report/head.h"
#include "apps/report/platens.h"
#include "apps/report/sleeve.h"
#include "apps/report/specimen_view.h"
#include "apps/report/stages.h"
#include "apps/report/strips.h"
#include "apps/report/viewer.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

void draw_comparison(const std::vector<Run> &runs, Album &album) {
  album.begin("Compared");
  album.add("comparison_stress_strain.png",
            "Stress and broken bonds against strain. A stronger run whose bonds break later was held at its "
            "ends.",
            draw_stress_strain, runs);
  if (std::any_of(runs.begin(), runs.end(), has_stress_path))
    album.add("comparison_stress_path.png",
              "Mean stress and deviator of each run whose sides are pressed: where the paths end, it failed.",
              draw_stress_path, runs);
  if (const BiaxialStrengths strengths = biaxial_strengths(runs); tells_envelope(strengths))
    album.add("comparison_biaxial.png",
              "Strength under two stresses over the uniaxial one. Diamond: published, equal stresses.",
              draw_biaxial, strengths);
  if (std::all_of(runs.begin(), runs.end(), [](const Run &run) { return run.specimen.empty(); })) return;
  album.add("comparison_displacement.png",
            "Half specimens at the end, coloured by outward displacement: what is dark stood still.",
            draw_side_by_side, runs, Quantity::outward_displacement);
  album.add("comparison_damage.png",
            "Half specimens coloured by the share of each sphere's bonds that is broken: grey is sound.",
            draw_side_by_side, runs, Quantity::damage);
  if (std::any_of(runs.begin(), runs.end(), tells_dead_zones))
    album.add(
        "comparison_cones.png",
        "What has moved with each platen from the peak to 0.8 of it, and the cones fitted to that: cones by "
        "displacement.",
        draw_side_by_side, runs, Quantity::dead_zones);
  if (std::any_of(runs.begin(), runs.end(), tells_fragments))
    album.add("comparison_fragments.png", "Pieces at the end that bonds still hold together.",
              draw_side_by_side, runs, Quantity::pieces);
}

void draw_curves(const Run &run, Album &album) {
  album.begin("Stress and energy");
  album.add("stress_strain.png",
            "Stress against strain between the platens and in the gauge; broken bonds; volume. "
            "The two axial strains differ by what the ends take up; where the volume begins to grow, cracks "
            "open. Dots: the peak. The widest strains are cut off.",
            draw_stress_strain, std::vector<Run>{run});
  album.add("energies.png",
            "The energy ledger: where the work of the platens went. Its residual should not leave the zero "
            "line.",
            draw_energies, run);
  if (tells_opening(run))
    album.add("opening.png",
              run.history.has("deflection_m")
                  ? "Nominal flexural stress against what the bar bends at mid-span."
                  : "Splitting stress against what the disc widens across the loaded diameter.",
              draw_opening, run);
  if (has_cell(run))
    album.add("confinement.png",
              "What the cell leaves to the platens: deviator and volume against strain, and the pressure of "
              "the cell "
              "over time. Where the volume begins to grow, cracks open against the pressure.",
              draw_confinement, run);
  if (has_stress_path(run))
    album.add(
        "stress_path.png",
        "Mean stress against deviator of the stresses along x, y and z. A bare test follows the dashed line; "
        "what presses the sides bends the path away from it.",
        draw_stress_path, std::vector<Run>{run});
  if (!stages_of(run).empty()) {
    album.begin("Stages");
    album.add_table(table_of_stages(run));
    album.add("stages.png",
              "The path of the test, stage by stage. What comes back on a path is drawn narrower on it. "
              "Strains count "
              "from the end of a consolidation; the widest lateral strains are cut off.",
              draw_stages, run);
  }
  if (!has_further_sides(run)) return;
  album.begin("Sides");
  album.add_table(table_of_sides(run));
  album.add("side_stresses.png",
            "Stress on each platen. Two opposite ones bear the same but for what friction takes over: dashed "
            "and solid "
            "lines of a colour.",
            draw_side_stresses, run);
}

void draw_specimen(const Run &run, const Extent &extent, Album &album) {
  album.begin("The specimen");
  album.add(
      "specimen_outside.png",
      "From outside, coloured by how far each sphere has gone: before the test, near the peak, at the end.",
      draw_three_moments, run, extent, true);
  album.add("specimen_inside.png", "The same, cut in half.", draw_three_moments, run, extent, false);
  album.add(
      "outward_displacement.png",
      "Half specimen coloured by outward displacement: cones stay dark, what they wedge aside is light.",
      draw_pattern_and_end, run, extent, Quantity::outward_displacement);
  album.add("damage.png",
            "Half specimen coloured by the share of each sphere's bonds that is broken: grey is sound.",
            draw_pattern_and_end, run, extent, Quantity::damage);
  if (tells_dead_zones(run))
    album.add("cones.png", dead_zones_caption(run), draw_pattern_and_end, run, extent, Quantity::dead_zones);
  if (tells_fragments(run))
    album.add("fragments.png", "Half specimen, the pieces that bonds still hold together in colours.",
              draw_pattern_and_end, run, extent, Quantity::pieces);
}

void draw_all_cracks(const Run &run, const Spheres &before_test, bool is_plane, Album &album) {
  if (!run.cracks) return;
  album.begin("Cracks");
  album.add("cracks.png", "Broken bonds as discs, in tension (left) and in shear (right).", draw_cracks, run,
            before_test);
  album.add(
      "crack_times.png",
      "The same discs by when they broke. What is empty on the right stood still while the rest failed.",
      draw_crack_times, run, before_test);
  album.add("crack_density.png",
            std::string("Broken bonds over height and distance from the ") +
                (is_plane ? "middle plane" : "axis") + "; the left half mirrors the right.",
            draw_crack_density, run, before_test);
  if (tells_rose(run))
    album.add(
        "crack_rose.png",
        "Which way cracks face, all of the run: beyond the line there are more than if they faced all ways "
        "alike. Cracks at 90 degrees run along the specimen: it splits.",
        draw_crack_rose, run);
}

void draw_events(const Run &run, Album &album) {
  if (!tells_magnitudes(run)) return;
  album.begin("Acoustic emission");
  album.add("acoustic.png", acoustic_caption(run), draw_acoustic, run);
}

void draw_ends(const Run &run, const Spheres &before_test, const Extent &extent, Album &album) {
  if (run.contacts.empty()) return;
  album.begin("Platens and ends");
  if (tells_stress(run))
    album.add(
        "stress_flow.png",
        "Stress in the plane y = 0 near the peak, averaged over the spheres; on the left the vertical "
        "stress, compression positive, on the right the largest shear. Elastic platens carry it on; rigid "
        "ones are grey.",
        draw_stress_flow, run, before_test);
  if (tells_friction(run))
    album.add("friction.png",
              "How friction holds: the share of spheres at each platen that slide, friction over pressure "
              "beside the "
              "limits of the scene, how far they have slid (the mean, by pressure), and the work of it. "
              "Platens hold "
              "as long as friction stays below its limit.",
              draw_friction, run);
  const double radius = mean_radius(before_test);
  if (has_strips(run))
    album.add("strip_loads.png",
              "Load along each strip near the peak: an even strip bears the same everywhere.",
              draw_strip_loads, run, extent, radius);
  else if (has_further_sides(run) || extent.form == Extent::Form::box)
    album.add("side_pressure.png",
              "Pressure on each platen over the face of the specimen near the peak, over the mean of that "
              "platen: what stays dark is borne "
              "elsewhere.",
              draw_face_pressures, run, extent, radius);
  else if (extent.form == Extent::Form::cylinder)
    album.add(
        "platen_pressure.png",
        "Pressure on the platens and shear on the ends over the radius, near the peak: friction holds an "
        "end together by inward shear.",
        draw_platen_profiles, run, extent);
  if (!is_glued(run))
    album.add("stick_slip.png", "Spheres at each platen near the peak: which stick and which slide.",
              draw_stick_and_slip, run, extent);
}

void draw_sleeves(const Run &run, const Extent &extent, Album &album) {
  if (run.sleeve.empty()) return;
  album.begin("The sleeve");
  album.add(
      "sleeve.png",
      "Half of the specimen in its sleeve, as it is deformed. Spheres by outward displacement: where the "
      "sleeve bulges, the specimen fails.",
      draw_sleeve, run, extent);
  album.add(
      "sleeve_unrolled.png",
      "The inner face of the sleeve unrolled: how much it is stretched around, what the spheres press on it "
      "(what the cell's pressure does not find there, it finds in gaps between spheres), and how far they "
      "have slid "
      "along it.",
      draw_sleeve_unrolled, run);
}

void draw_one_run(const Run &run, Album &album) {
  draw_curves(run, album);
  draw_events(run, album);
  if (run.specimen.empty()) return;
  const Spheres before_test = read_spheres(run.specimen.front());
  const Extent extent = extent_of(before_test);
  album.begin("The specimen, to be turned");
  album.add_element(specimen_view_html(run, extent));
  draw_specimen(run, extent, album);
  draw_all_cracks(run, before_test, extent.is_plane(), album);
  draw_ends(run, before_test, extent, album);
  draw_sleeves(run, extent, album);
}

// Throws InputError where a frame that pictures are drawn of is damaged: before the first of them.
void require_frames(const Run &run) {
  if (run.specimen.empty()) return;
  read_spheres(run.specimen.front());
  for (const double time : {run.moments.peak_time, run.pattern_time(), run.moments.end_time})
    read_spheres(nearest(run.specimen, time));
  if (!run.contacts.empty()) contacts_with(Side::top, nearest(run.contacts, run.moments.peak_time));
}

} // namespace

void write_report(const std::vector<Run> &runs, const fs::path &folder, std::ostream &out) {
  for (const Run &run : runs)
    require_frames(run);
  Album album(folder);
  std::vector<std::string> remarks;
  for (const Run &run : runs) {
    if (const auto version = run.summary.find("version");
        version != run.summary.end() && version->is_string())
      remarks.push_back(run.name + ": " + version->get<std::string>());
    for (const std::string &remark : run.remarks) {
      remarks.push_back(run.name + ": " + remark);
      out << remarks.back() << '\n';
    }
  }
  std::vector<Results> results;
  for (const Run &run : runs)
    results.push_back(results_of(run));
  add_head(results, album);
  if (const TableOfFigures validity = table_of_validity(runs); !validity.rows.empty()) {
    album.begin("Which figures count");
    album.add_table(validity);
  }
  for (const Run &run : runs)
    if (!run.peak_reached().value_or(true))
      remarks.push_back(run.name + ": no peak reached: the largest stress is no strength");
  if (runs.size() > 1) draw_comparison(runs, album);
  if (runs.size() > 1)
    for (const std::string &remark : biaxial_strengths(runs).left_out)
      out << remark << '\n', remarks.push_back(remark);
  draw_one_run(runs.front(), album);
  if (!costs_of(runs.front()).empty()) {
    album.begin("Where the seconds went");
    album.add("seconds.png", machine_words(runs.front()), draw_costs, runs.front());
  }
  album.finish(runs.front().title, table_of_figures(runs), remarks, out);
}

} // namespace platen::apps::report
