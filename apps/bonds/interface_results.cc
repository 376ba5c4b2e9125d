#include "apps/bonds/interface_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/io/csv_writer.h"

namespace platen::apps {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

} // namespace

bool is_led(const Scene &scene) {
  return scene.bond.remembers();
}

BondRun lead_bond(const Scene &scene, double modulus) {
  InterfaceRig rig(scene, modulus);
  BondRun run;
  run.modulus = modulus;
  run.stiffness_ratio = rig.section().shear_stiffness() / rig.section().normal_stiffness();
  run.bonds = static_cast<int>(rig.model().intact_bonds());
  run.bond_area = rig.section().area;
  run.time_step = none;
  run.time_step_reason = "none: spheres are led without inertia";
  run.led = follow_interface(rig, scene);
  run.path = run.led.path;
  run.steps = rig.steps();
  run.clock = rig.model().clock;
  run.fracture_work = rig.model().works.fracture;
  run.broken_tension = rig.model().broken_tension;
  run.broken_shear = rig.model().broken_shear;
  run.stiffness_by_hand = run.led.stiffness_by_hand;
  run.strength_by_hand = run.led.strength_by_hand;
  run.strain_ratio_by_hand = none;
  return run;
}

void write_interface_table(const std::filesystem::path &path, const Scene &scene,
                           const std::vector<BondRun> &runs) {
  std::vector<std::string> columns = bond_columns();
  columns.insert(columns.end(), {"shear_by_hand_n", "tension_damage", "shear_damage", "plastic_closing_m",
                                 "work_j", "stored_j", "dissipated_j", "dissipated_by_hand_j"});
  WholeTable table(path, columns);
  const bool slides = scene.pair_test.path == PairPath::shear;
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (std::size_t n = 0; n < runs[k].path.rows.size(); ++n) {
      const RigReading &r = runs[k].path.rows[n];
      const InterfaceRow &row = runs[k].led.rows[n];
      const InterfaceReading &m = row.measured;
      table.row({k + 1,
                 runs[k].modulus,
                 runs[k].stiffness_ratio,
                 r.force,
                 r.displacement,
                 0.0,
                 0.0,
                 r.normal,
                 r.shear,
                 r.tension_ratio,
                 r.shear_ratio,
                 r.intact,
                 0.0,
                 none,
                 slides ? row.by_hand.shear : row.by_hand.normal,
                 runs[k].led.difference(n),
                 row.by_hand.shear,
                 m.tension_damage,
                 m.shear_damage,
                 m.plastic_closing,
                 m.work,
                 m.stored,
                 m.dissipated,
                 row.dissipated_by_hand});
    }
  table.finish();
}

std::string interface_report(const Scene &scene, const std::vector<BondRun> &runs) {
  const bool slides = scene.pair_test.path == PairPath::shear;
  std::string text = fmt::format("  {:>10} {:>14} {:>14} {:>14} {:>8} {:>11}\n", "modulus", "displacement",
                                 "force", "by hand", "damage", "difference");
  text +=
      fmt::format("  {:>10} {:>14} {:>14} {:>14} {:>8} {:>11}\n", "GPa", "um", "N", "N", "", "of largest");
  for (const BondRun &run : runs) {
    const std::size_t rows = run.path.rows.size(), shown = std::min<std::size_t>(rows, 12);
    for (std::size_t k = 1; k <= shown; ++k) {
      const std::size_t n = k * rows / shown - 1;
      const RigReading &row = run.path.rows[n];
      const InterfaceRow &at = run.led.rows[n];
      text +=
          fmt::format("  {:>10.6g} {:>14.7g} {:>14.7g} {:>14.7g} {:>8.4f} {:>11.2e}\n", 1e-9 * run.modulus,
                      1e6 * row.displacement, row.force, slides ? at.by_hand.shear : at.by_hand.normal,
                      std::max(at.measured.tension_damage, at.measured.shear_damage), run.led.difference(n));
    }
    const InterfaceRow &last = run.led.rows.back();
    text += fmt::format("  dissipated {:.10g} J; by hand {:.10g} J\n", last.measured.dissipated,
                        last.dissipated_by_hand);
    if (!std::isnan(run.path.break_load))
      text +=
          fmt::format("  strength {:.10g} N; by hand {:.10g} N\n", run.path.break_load, run.strength_by_hand);
    if (!std::isnan(run.led.fracture_energy))
      text += fmt::format("  fracture energy {:.10g} J/m2; by hand {:.10g} J/m2\n", run.led.fracture_energy,
                          run.led.fracture_energy_by_hand);
  }
  return text;
}

void add_interface_summary(const BondRun &run, Json &j) {
  const InterfaceRow &last = run.led.rows.back();
  // The first place on the driven way: a sheared bond is pressed first.
  const auto moved = std::find_if(run.path.rows.begin(), run.path.rows.end(),
                                  [](const RigReading &row) { return row.displacement != 0; });
  j["stiffness"] = moved != run.path.rows.end() ? moved->force / moved->displacement : none;
  j["largest_difference"] = run.led.largest_difference();
  j["work_j"] = last.measured.work;
  j["stored_j"] = last.measured.stored;
  j["dissipated_j"] = last.measured.dissipated;
  j["dissipated_by_hand_j"] = last.dissipated_by_hand;
  j["fracture_energy_j_m2"] = run.led.fracture_energy;
  j["fracture_energy_by_hand_j_m2"] = run.led.fracture_energy_by_hand;
  j["plastic_closing_m"] = last.measured.plastic_closing;
}

} // namespace platen::apps
