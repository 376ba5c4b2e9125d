#include "apps/calibrate/run_calibrate.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "apps/calibrate/search.h"
#include "apps/io/file.h"
#include "apps/io/machine.h"
#include "apps/io/stop_signal.h"
#include "apps/run/app_output.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/units.h"
#include "apps/scene/version.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

std::string description(const Scene &scene) {
  const Calibrate &c = scene.calibrate;
  std::string text = title_of(scene);
  text += fmt::format("\n  {}: {} seeds to calibrate on, {} to judge by\n", word_of(calibrate_modes, c.mode),
                      c.seeds, c.mode == CalibrateMode::search ? c.verification_seeds : 0);
  const auto say = [&](const char *what, double value, const char *unit, double factor) {
    if (!std::isnan(value)) text += fmt::format("  wanted: {} {:.5g}{}\n", what, factor * value, unit);
  };
  if (c.mode != CalibrateMode::search) return text;
  say("Young's modulus", c.young_modulus, " GPa", 1e-9);
  say("Poisson's ratio", c.poisson_ratio, "", 1);
  say("compressive strength", c.compressive_strength, " MPa", 1e-6);
  say("tensile strength", c.tensile_strength, " MPa", 1e-6);
  if (!std::isnan(c.triaxial_strength))
    text += fmt::format("  wanted: triaxial strength {:.5g} MPa at a pressure of {:.5g} MPa\n",
                        1e-6 * c.triaxial_strength, 1e-6 * c.confining_pressure);
  return text;
}

void tell_bounds(const Scene &scene, Trials &trials, RunLog &log, Json &s) {
  const dem::Specimen &first = trials.packing(scene.general.seed);
  const dem::NetworkModuli b = bounds_of(scene, first, choice_of(scene));
  log.info(
      "  of the bonds alone, as the scene has them: E at most {:.5g} GPa (Voigt, nu {:.4f}), about {:.5g} "
      "GPa "
      "(Reuss, nu {:.4f})",
      1e-9 * b.young_voigt, b.poisson_voigt, 1e-9 * b.young_reuss, b.poisson_reuss);
  s["particles"] = first.size();
  s["bounds"] = {{"young_voigt_pa", b.young_voigt},
                 {"poisson_voigt", b.poisson_voigt},
                 {"young_reuss_pa", b.young_reuss},
                 {"poisson_reuss", b.poisson_reuss}};
}

Json json_of(const SeedStatistics &scatter) {
  return {{"mean", scatter.mean()}, {"deviation", scatter.deviation()}, {"seeds", scatter.count()}};
}
Json json_of(const Measured &m) {
  return {{"youngs_modulus_gauge_pa", json_of(m.young)},
          {"youngs_modulus_platen_pa", json_of(m.platen)},
          {"poisson_ratio", json_of(m.poisson)},
          {"compressive_strength_pa", json_of(m.compressive)},
          {"tensile_strength_pa", json_of(m.tensile)},
          {"triaxial_strength_pa", json_of(m.triaxial)},
          {"failed", m.failed}};
}

std::string row_of(const char *what, double unit, double wanted, const SeedStatistics &training,
                   const SeedStatistics &unseen) {
  const std::string goal = std::isnan(wanted) ? "-" : fmt::format("{:.4g}", wanted / unit);
  const double off = 100 * (unseen.mean() / wanted - 1);
  return fmt::format("  {:<26} {:>8} {:>20} {:>20} {:>9}\n", what, goal, text_of(training, unit),
                     text_of(unseen, unit), std::isnan(off) ? "" : fmt::format("{:+.1f} %", off));
}

std::string table_of(const Scene &scene, const Found &f) {
  const Calibrate &c = scene.calibrate;
  std::string text = fmt::format("  {:<26} {:>8} {:>20} {:>20} {:>9}\n", "", "wanted", "calibrated on",
                                 "unseen seeds", "off");
  text += row_of("Young's modulus, GPa", 1e9, c.young_modulus, f.training.young, f.unseen.young);
  text += row_of("Poisson's ratio", 1, c.poisson_ratio, f.training.poisson, f.unseen.poisson);
  text += row_of("compressive strength, MPa", 1e6, c.compressive_strength, f.training.compressive,
                 f.unseen.compressive);
  text += row_of("tensile strength, MPa", 1e6, c.tensile_strength, f.training.tensile, f.unseen.tensile);
  if (!std::isnan(c.triaxial_strength))
    text +=
        row_of("triaxial strength, MPa", 1e6, c.triaxial_strength, f.training.triaxial, f.unseen.triaxial);
  return text;
}

// Where what is found stands: in summary.json and in a scene.
struct FoundNumber {
  const char *key, *entry, *unit;
  double BondChoice::*number;
};
constexpr FoundNumber found_numbers[] = {
    {"bond_modulus_pa", "Modulus", " Pa", &BondChoice::modulus},
    {"stiffness_ratio", "Stiffness ratio", "", &BondChoice::stiffness_ratio},
    {"radius_multiplier", "Radius multiplier", "", &BondChoice::radius_multiplier},
    {"bond_tensile_strength_pa", "Tensile strength", " Pa", &BondChoice::tensile_strength},
    {"bond_shear_strength_pa", "Shear strength", " Pa", &BondChoice::shear_strength},
    {"moment_contribution", "Moment contribution", "", &BondChoice::moment_contribution},
    {"friction_angle_rad", "Friction angle", " rad", &BondChoice::friction_angle}};

void tell_found(const Scene &scene, const Found &f, RunLog &log, Json &s) {
  const BondChoice &c = f.choice;
  for (const FoundNumber &one : found_numbers)
    s["found"][one.key] = c.*one.number;
  s["training"] = json_of(f.training);
  s["verification"] = json_of(f.unseen);
  const Measured &judged = f.unseen.young.count() > 0 ? f.unseen : f.training;
  s["youngs_modulus_gauge_pa"] = judged.young.mean();
  s["youngs_modulus_platen_pa"] = judged.platen.mean();
  s["poisson_ratio"] = judged.poisson.mean();
  s["strength_pa"] = judged.compressive.mean();
  s["tensile_strength_pa"] = judged.tensile.mean();
  s["triaxial_strength_pa"] = judged.triaxial.mean();
  s["strength_trials"] = f.strength_trials;
  s["missed"] = f.missed;
  log.info(
      "found: bond modulus {:.5g} GPa, stiffness ratio {:.5g}, radius multiplier {:.5g}, tensile strength "
      "{:.5g} "
      "MPa, shear strength {:.5g} MPa, moment contribution {:.4g}, friction angle {:.4g} degree\n{}",
      1e-9 * c.modulus, c.stiffness_ratio, c.radius_multiplier, 1e-6 * c.tensile_strength,
      1e-6 * c.shear_strength, c.moment_contribution, c.friction_angle * 180 / pi, table_of(scene, f));
  for (const std::string &line : f.missed)
    log.warning("{}", line);
}

// found.prm: the scene itself with what was found in it.
void write_found(const CommandLine &command, const Scene &scene, const Found &f, const AppOutput &output) {
  std::vector<std::string> overrides = command.overrides;
  for (const auto &[key, entry, unit, number] : found_numbers)
    if (number != &BondChoice::friction_angle ||
        f.choice.friction_angle != scene.bond.number("friction_angle"))
      overrides.push_back(fmt::format("Bond/{} = {}{}", entry, shortest_text(f.choice.*number), unit));
  const Scene found = read_scene(command.scene, overrides, AppKind::calibrate);
  std::string comment = fmt::format("Found by platen-calibrate from {} ({}).\n{}", found.name, version_line(),
                                    table_of(scene, f));
  for (const std::string &line : f.missed)
    comment += line + "\n";
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);)
    text += "# " + line + "\n";
  write_text_aside(output.paths.folder / "found.prm", text + scene_text(found, output.paths.folder));
}

} // namespace

int run_calibrate(const CommandLine &command, const Scene &scene) {
  if (command.dry_run) {
    fmt::print("{}", description(scene));
    return status_done;
  }
  AppOutput output(command, scene);
  catch_stop_signals();
  output.open();
  output.log.info("{}", description(scene));
  const CalibrateMode mode = scene.calibrate.mode;
  Json s = summary_head(scene, "platen-calibrate", "done", effects_on(scene));
  s["mode"] = word_of(calibrate_modes, mode);
  s["threads"] = output.threads();
  try {
    Trials trials(scene, output.paths, command.resume, output.log);
    tell_bounds(scene, trials, output.log, s);
    if (mode == CalibrateMode::abacus) s["abacus"] = make_abacus(scene, output.paths, trials, output.log);
    if (mode == CalibrateMode::search) {
      const Found found = search(scene, trials, output.log);
      tell_found(scene, found, output.log, s);
      write_found(command, scene, found, output);
    }
    s["trials"] = trials.made();
    s["failed_trials"] = trials.failed();
  } catch (const Stopped &stopped) {
    output.log.info("stopped by a signal; go on with: platen-calibrate {} -o {} --resume", command.scene,
                    command.output);
    return exit_status_of_signal(stopped.signal);
  }
  s["wall_seconds"] = output.seconds();
  s["peak_memory_bytes"] = peak_memory_bytes();
  return output.finish(s, fmt::format("results are in {}", output.paths.folder.string()));
}

} // namespace platen::apps
