#include "apps/bonds/run_bonds.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>

#include "apps/bonds/interface_results.h"
#include "apps/io/csv_writer.h"
#include "apps/io/file.h"
#include "apps/io/id_list.h"
#include "apps/io/machine.h"
#include "apps/io/output_folder.h"
#include "apps/io/run_log.h"
#include "apps/io/summary.h"
#include "apps/run/expectations.h"
#include "apps/scene/parameters.h"
#include "apps/scene/version.h"
#include "base/parallel.h"
#include "dem/laws/normal_contact.h"

namespace platen::apps {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool is_pyramid(const Scene &scene) {
  return scene.pair_test.particles == 3;
}
bool is_beam(const Scene &scene) {
  return scene.bond.is<dem::CohesiveBeam>();
}
bool turns(const Scene &scene) {
  return scene.pair_test.path == PairPath::bending || scene.pair_test.path == PairPath::twisting;
}
double load_of(const Scene &scene, const RigReading &row) {
  return turns(scene) ? row.moment : row.force;
}
double way_of(const Scene &scene, const RigReading &row) {
  return turns(scene) ? row.rotation : row.displacement;
}

void refuse(const Scene &scene, const std::string &path, const std::string &reason) {
  if (scene.parameters) scene.parameters->refuse(path, reason);
  throw InputError(path + " " + reason);
}

// What this test cannot do, or what its closed forms know nothing of.
void check(const Scene &scene) {
  const PairTest &test = scene.pair_test;
  if (!is_led(scene) && !is_beam(scene) && !scene.bond.is<dem::ParallelBond>())
    refuse(scene, "Effects/Bond", "has no closed form here. Allowed: any other.");
  if ((is_beam(scene) || is_led(scene)) && test.stiffness_ratios.size() > 1)
    refuse(scene, "Pair test/Stiffness ratio list",
           std::string("is for parallel bonds: ") +
               (is_beam(scene) ? "a beam has the ratio of its section."
                               : "an elasto damage plastic bond has that of Bond/Poisson ratio."));
  if (scene.phases.by == PhasesBy::file)
    read_id_list(scene.phases.file, static_cast<std::size_t>(test.particles)); // refuses ids of no sphere
  if (scene.effects.gravity)
    refuse(scene, "Effects/Gravity", "would load the bonds before the test does. Allowed: off.");
  if (is_led(scene)) return; // what else it asks for is checked with the scene
  if (scene.model.local_damping < .05)
    refuse(scene, "Integration/Damping",
           "lets the spheres swing for ever. Allowed: 0.05 ... 1 (0.7 is best).");
  if (!std::isnan(test.force) && !std::isnan(test.displacement))
    refuse(scene, "Pair test/Displacement",
           "contradicts Pair test/Force. Allowed: one of both drives the test.");
  if (!scene.model.rotation && turns(scene))
    refuse(scene, "Effects/Rotation", "is off, but Pair test/Path turns a sphere. Allowed: on.");
  if (!is_pyramid(scene)) return;
  if (test.path != PairPath::compression && test.path != PairPath::cyclic)
    refuse(scene, "Pair test/Path",
           "needs two particles: three stand on a plate that cannot pull. Allowed: compression, cyclic.");
  if (!scene.model.rotation && test.plate == PairPlate::rolling)
    refuse(scene, "Pair test/Plate", "= rolling needs Effects/Rotation = on.");
  if (!test.base_bond && scene.effects.contact)
    refuse(
        scene, "Pair test/Base bond",
        "= off needs Effects/Contact = none: the base spheres touch, and the closed form knows no contact.");
}

const char *word(PairPath path) {
  constexpr const char *words[] = {"tension",  "compression", "shear",   "bending",
                                   "twisting", "cyclic",      "combined"};
  return words[static_cast<int>(path)];
}
const char *word(PairPlate plate) {
  constexpr const char *words[] = {"frictionless", "rolling", "sticking"};
  return words[static_cast<int>(plate)];
}

std::string description(const Scene &scene) {
  const PairTest &t = scene.pair_test;
  std::string text = scene.general.title.empty() ? scene.name : scene.general.title;
  text += fmt::format("\n  {} spheres of radius {:g} m, {}", t.particles, scene.specimen.sphere_radius,
                      word(t.path));
  if (!std::isnan(t.force))
    text += fmt::format(" up to {:g} {}", t.force * (turns(scene) ? scene.specimen.sphere_radius : 1),
                        turns(scene) ? "N m" : "N");
  else if (!t.turns.empty())
    text += fmt::format(" by {} turns to {:g} m", t.turns.size(), t.turns.back());
  else
    text += fmt::format(" up to {:g} {}", t.displacement / (turns(scene) ? scene.specimen.sphere_radius : 1),
                        turns(scene) ? "rad" : "m");
  text += fmt::format(" in {} steps\n", t.steps);
  if (is_pyramid(scene))
    text += fmt::format("  plate {}, base bond {}\n", word(t.plate), t.base_bond ? "on" : "off");
  text += fmt::format("  rotation {}; {} moduli, {} stiffness ratios\n", scene.model.rotation ? "on" : "off",
                      t.moduli.size(), t.stiffness_ratios.size());
  return text;
}

BondRun run_one(const Scene &scene, double modulus, double ratio) {
  if (is_led(scene)) return lead_bond(scene, modulus);
  BondRig rig(scene, modulus, ratio);
  BondRun run;
  run.modulus = modulus;
  run.stiffness_ratio = rig.section().shear_ratio();
  run.bonds = rig.bonds_at_start();
  run.bond_area = rig.section().area();
  run.time_step = rig.time_step();
  run.time_step_reason = rig.time_step_reason();
  run.path = follow_path(rig, scene);
  run.steps = rig.steps();
  run.clock = rig.model().clock;
  run.fracture_work = rig.model().works.fracture;
  run.broken_tension = rig.model().broken_tension;
  run.broken_shear = rig.model().broken_shear;
  const PairTest &t = scene.pair_test;
  run.strain_ratio_by_hand = none;
  if (is_pyramid(scene)) {
    const PyramidResponse by_hand =
        pyramid_response({rig.section(), t.plate, t.base_bond, scene.model.rotation});
    run.stiffness_by_hand = by_hand.stiffness;
    run.strain_ratio_by_hand = by_hand.strain_ratio;
    run.strength_by_hand = none;
  } else {
    run.stiffness_by_hand = pair_stiffness(rig.section(), t.path);
    run.strength_by_hand = pair_strength(rig.section(), t.path);
  }
  return run;
}

double relative(double measured, double by_hand) {
  if (std::isnan(measured) || std::isnan(by_hand)) return none;
  return by_hand == 0 ? measured : measured / by_hand - 1; // of nothing: the difference itself
}

// Largest difference of a row that carries at least a hundredth of the load.
double largest_difference(const Scene &scene, const BondRun &run) {
  if (is_led(scene)) return run.led.largest_difference();
  double largest = 0;
  const double peak = std::abs(load_of(scene, run.path.largest));
  for (const RigReading &row : run.path.rows) {
    const double d = relative(row_measured(scene, row), row_by_hand(scene, run, row));
    if (std::abs(load_of(scene, row)) >= .01 * peak && std::abs(d) > largest) largest = std::abs(d);
  }
  return largest;
}

void write_table(const std::filesystem::path &path, const Scene &scene, const std::vector<BondRun> &runs) {
  if (is_led(scene)) return write_interface_table(path, scene, runs);
  WholeTable table(path, bond_columns());
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const RigReading &r : runs[k].path.rows) {
      const double by_hand = row_by_hand(scene, runs[k], r);
      table.row({k + 1, runs[k].modulus, runs[k].stiffness_ratio, r.force, r.displacement, r.moment,
                 r.rotation, r.normal, r.shear, r.tension_ratio, r.shear_ratio, r.intact, r.lateral,
                 r.strain_ratio, by_hand, relative(row_measured(scene, r), by_hand)});
    }
  table.finish();
}

// Up to six rows of a run, evenly: what the screen shows; the table in bonds.csv has all.
std::string report(const Scene &scene, const std::vector<BondRun> &runs) {
  if (is_led(scene)) return interface_report(scene, runs);
  const bool three = is_pyramid(scene);
  std::string text = fmt::format(
      "  {:>10} {:>7} {:>12} {:>14} {:>14} {:>11}\n", "modulus", "ks/kn", turns(scene) ? "moment" : "force",
      three ? "strain ratio" : (turns(scene) ? "rotation" : "displacement"), "by hand", "difference");
  text += fmt::format("  {:>10} {:>7} {:>12} {:>14} {:>14} {:>11}\n", "GPa", "", turns(scene) ? "N m" : "N",
                      three ? "" : (turns(scene) ? "rad" : "mm"), "", "");
  const double unit = three || turns(scene) ? 1 : 1e3;
  for (const BondRun &run : runs) {
    const std::size_t rows = run.path.rows.size(), shown = std::min<std::size_t>(rows, 6);
    for (std::size_t k = 1; k <= shown; ++k) {
      const RigReading &row = run.path.rows[k * rows / shown - 1];
      const double measured = row_measured(scene, row), by_hand = row_by_hand(scene, run, row);
      text += fmt::format("  {:>10.6g} {:>7.4g} {:>12.6g} {:>14.7g} {:>14.7g} {:>11.2e}\n",
                          1e-9 * run.modulus, run.stiffness_ratio, load_of(scene, row), unit * measured,
                          unit * by_hand, relative(measured, by_hand));
    }
    if (std::isnan(run.path.break_load)) continue;
    text += fmt::format("  broken at {:.6g} {}", run.path.break_load, turns(scene) ? "N m" : "N");
    if (!std::isnan(run.strength_by_hand))
      text += fmt::format("; by hand {:.6g}, difference {:.2e}", run.strength_by_hand,
                          relative(std::abs(run.path.break_load), run.strength_by_hand));
    text += "\n";
  }
  return text;
}

Json summary_of(const Scene &scene, const BondRun &run) {
  const RigReading &r = run.path.largest;
  const double load = load_of(scene, r), way = way_of(scene, r);
  Json j;
  j["modulus_pa"] = run.modulus;
  j["stiffness_ratio"] = run.stiffness_ratio;
  j["largest_load"] = load;       // N; N m in bending and twisting
  j["way_at_largest_load"] = way; // m; rad
  j["stiffness"] = way != 0 ? load / way : none;
  j["stiffness_by_hand"] = run.stiffness_by_hand;
  j["strain_ratio"] = r.strain_ratio;
  j["strain_ratio_by_hand"] = run.strain_ratio_by_hand;
  j["break_load"] = run.path.break_load;
  j["break_load_by_hand"] = run.strength_by_hand;
  j["break_stress_pa"] = turns(scene) ? none : std::abs(run.path.break_load) / run.bond_area;
  j["fracture_work_j"] = run.fracture_work;
  j["largest_difference"] = largest_difference(scene, run);
  j["steps"] = run.steps;
  if (is_led(scene)) add_interface_summary(run, j);
  return j;
}

struct Costs {
  int threads = 1;
  double seconds = 0;
};

Json summary_of(const Scene &scene, const std::vector<BondRun> &runs, const Costs &costs) {
  Json s;
  s["status"] = "done";
  s["app"] = "platen-bonds";
  s["scene"] = scene.general.title.empty() ? scene.name : scene.general.title;
  s["version"] = version_line();
  std::vector<std::string> effects{scene.bond.word()};
  if (scene.model.rotation) effects.emplace_back("rotation");
  if (scene.model.rotation && !is_led(scene)) effects.emplace_back("bond moments");
  if (scene.effects.contact) effects.push_back(dem::word(*scene.effects.contact) + std::string(" contact"));
  if (scene.model.bond_dashpot > 0 && !is_led(scene)) effects.emplace_back("bond dashpots");
  if (!is_led(scene)) effects.emplace_back("local damping");
  s["effects"] = effects;
  s["path"] = word(scene.pair_test.path);
  s["particles"] = scene.pair_test.particles;
  s["bonds"] = runs.front().bonds;
  s["coordination_number"] = 2.0 * runs.front().bonds / scene.pair_test.particles;
  s["packing_fraction"] = none;
  long steps = 0;
  long broken_tension = 0, broken_shear = 0;
  double largest = 0;
  Json list = Json::array();
  for (const BondRun &run : runs) {
    steps += run.steps;
    broken_tension += run.broken_tension;
    broken_shear += run.broken_shear;
    largest = std::max(largest, largest_difference(scene, run));
    list.push_back(summary_of(scene, run));
  }
  s["steps"] = steps;
  s["time_step_s"] = runs.front().time_step;
  s["time_step_reason"] = runs.front().time_step_reason;
  s["threads"] = costs.threads;
  s["wall_seconds"] = costs.seconds;
  s["setup_seconds"] = none;
  s["particle_steps_per_second"] = scene.pair_test.particles * static_cast<double>(steps) / costs.seconds;
  for (int k = 0; k < dem::stage_count; ++k) {
    double seconds = 0;
    for (const BondRun &run : runs)
      seconds += run.clock.seconds(static_cast<dem::Stage>(k));
    s["stage_seconds"][dem::stage_names[static_cast<std::size_t>(k)]] = seconds;
  }
  s["peak_memory_bytes"] = peak_memory_bytes();
  for (const char *unmeasured : {"strength_pa", "strain_at_peak_platen", "strain_at_peak_gauge",
                                 "youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio"})
    s[unmeasured] = none;
  s["broken_tension"] = broken_tension;
  s["broken_shear"] = broken_shear;
  for (const char *unmeasured :
       {"energy_residual_relative", "kinetic_to_internal_max", "end_damage_top", "end_damage_bottom",
        "middle_damage", "end_spread", "barrel_at_peak", "fragments", "cone_top", "cone_bottom"})
    s[unmeasured] = none;
  s["largest_difference"] = largest;
  s["runs"] = list;
  return s;
}

std::string scene_text(const Scene &scene, const std::filesystem::path &folder) {
  std::ostringstream text;
  write_scene(scene, folder.string(), text);
  return text.str();
}

} // namespace

const std::vector<std::string> &bond_columns() {
  static const std::vector<std::string> columns{"run",
                                                "modulus_pa",
                                                "stiffness_ratio",
                                                "force_n",
                                                "displacement_m",
                                                "moment_nm",
                                                "rotation_rad",
                                                "bond_normal_n",
                                                "bond_shear_n",
                                                "tension_utilisation",
                                                "shear_utilisation",
                                                "intact_bonds",
                                                "lateral_m",
                                                "strain_ratio",
                                                "by_hand",
                                                "difference"};
  return columns;
}

double row_measured(const Scene &scene, const RigReading &row) {
  return is_pyramid(scene) ? row.strain_ratio : way_of(scene, row);
}

double row_by_hand(const Scene &scene, const BondRun &run, const RigReading &row) {
  if (row.intact < run.bonds) return none;
  return is_pyramid(scene) ? run.strain_ratio_by_hand : load_of(scene, row) / run.stiffness_by_hand;
}

std::vector<BondRun> run_bond_tests(const Scene &scene) {
  check(scene);
  std::vector<BondRun> runs;
  for (const double modulus : scene.pair_test.moduli)
    for (const double ratio : scene.pair_test.stiffness_ratios)
      runs.push_back(run_one(scene, modulus, ratio));
  return runs;
}

int run_bonds(const CommandLine &command, const Scene &scene) {
  check(scene);
  if (command.resume)
    throw InputError("--resume: a bond test takes seconds and keeps no checkpoint; run it anew");
  const OutputPaths paths(command.output);
  const FolderUse use = command.overwrite ? FolderUse::overwrite : FolderUse::fresh;
  if (command.dry_run && is_led(scene)) {
    const InterfaceRig rig(scene, scene.pair_test.moduli.front());
    fmt::print("{}  led without inertia: no time step\n", description(scene));
    return status_done;
  }
  if (command.dry_run) {
    const BondRig rig(scene, scene.pair_test.moduli.front(), scene.pair_test.stiffness_ratios.front());
    fmt::print("{}  time step {:.4g} s ({})\n", description(scene), rig.time_step(), rig.time_step_reason());
    return status_done;
  }
  check_output_folder(paths.folder, use, {command.scene});
  const auto start = std::chrono::steady_clock::now();
  const ThreadLimit limit(command.threads);
  RunLog log(command.quiet ? Loudness::quiet : (command.verbose ? Loudness::verbose : Loudness::normal));
  Costs costs;
  costs.threads = loop_threads();
  open_output_folder(paths.folder, use, {command.scene});
  log.open(paths.log(), false, {version_text(), command.text, costs.threads});
  log.info("{}", description(scene));
  write_text_aside(paths.scene(), scene_text(scene, paths.folder));
  const std::vector<BondRun> runs = run_bond_tests(scene);
  costs.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_table(paths.folder / "bonds.csv", scene, runs);
  const Json summary = summary_of(scene, runs, costs);
  write_summary(paths.summary(), summary);
  log.info("{}", report(scene, runs));
  log.info("  {:.2f} s; results are in {}", costs.seconds, paths.folder.string());
  return tell_expectations(scene, summary, log);
}

} // namespace platen::apps
