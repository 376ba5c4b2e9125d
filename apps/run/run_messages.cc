#include "apps/run/run_messages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "apps/run/app_output.h"
#include "apps/run/controls.h"
#include "apps/run/problem_setup.h"
#include "apps/run/ranks.h"
#include "apps/run/specimen_setup.h"
#include "apps/run/test_record.h"
#include "apps/scene/layers.h"
#include "apps/scene/surfaces.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

// Of the loaded length: what is pressed further is rubble between two plates, and no specimen of its height
// and section. Laboratories end tests of soil at half of this.
constexpr double most_shortened = 0.3;

// Extent and shares of the specimen's ends that platens cover.
std::string text_of_cover(const coupling::PlatenTest &test) {
  std::vector<std::string> covers;
  for (const coupling::Side side : coupling::all_sides)
    if (const auto cover = test.cover(side))
      covers.push_back(fmt::format("{} {:.4g} mm x {:.4g} mm, facing {:.2f} of the end",
                                   coupling::name_of(side), 1e3 * cover->extent[0], 1e3 * cover->extent[1],
                                   cover->facing));
  return covers.empty() ? "" : fmt::format("  platens: {}\n", fmt::join(covers, "; "));
}

std::string text_of_size(const Scene &scene) {
  const SizeCorrection &size = scene.bond.size;
  if (!(size.reference > 0) || !size.corrects()) return "";
  const double share = size.share(scene.specimen);
  return fmt::format(
      "  bonds for spheres of {:.4g} times the calibrated radius{}: modulus x {:.4f}, strengths x {:.4f}\n",
      share, size.by_width() ? " over the width" : "", std::pow(share, size.modulus_exponent),
      std::pow(share, size.strength_exponent));
}

// Platens, what presses the side, and the machine, as far as they are more than rigid plates.
std::string text_of_parts(const coupling::PlatenTest &test) {
  std::string text;
  if (const coupling::SkinPressure *pressed = test.skin())
    text +=
        fmt::format("  confinement: {} spheres of the skin with {:.3f} of the lateral area, ramp {:.3g} s\n",
                    pressed->skin().size(), pressed->skin().coverage(test.model.particles, test.end_planes()),
                    test.cell_ramp());
  if (const coupling::Sleeve *sleeve = test.sleeve())
    text += fmt::format(
        "  sleeve: {} elements, {} spheres lie flush with it, stepped once in {}, mass times {:.3g}, ramp "
        "{:.3g} s\n",
        sleeve->solid().mesh().cells.size(), sleeve->layer().seats(),
        sleeve->steps_of_next_interval(test.time_step()), sleeve->mass_scaling(), test.cell_ramp());
  if (const coupling::ElasticPlaten *top = test.elastic_top())
    text += fmt::format("  platens: {}, {} nodes each, {} of their own steps in a time step\n",
                        test.platens_yield() ? "yielding" : "elastic", top->solid().model().nodes.size(),
                        top->solid().substeps(test.time_step()));
  if (const double behind = test.seconds_behind(); behind > 0)
    text += fmt::format("  platens without inertia come {:.3g} s after their loads\n", behind);
  if (const coupling::MachineSpring *machine = test.machine()) {
    const double k = machine->settings().stiffness, mass = machine->settings().mass;
    text += fmt::format("  machine: a spring of {:.4g} N/m with {:.3g} kg on it, period {:.3g} s\n", k, mass,
                        2 * pi * std::sqrt(mass / k));
  }
  return text;
}

} // namespace

std::string ended_by(const Scene &scene, const coupling::PlatenTest &test, const Results &results) {
  if (test.program().finished()) return "target";
  if (scene.loading.stop_at_residual > 0 && results.fallen_to(scene.loading.stop_at_residual))
    return "stop at residual";
  if (std::abs(test.closure_strain(results.axis())) > most_shortened) return "shortened too far";
  return "";
}

std::string description_of(const Scene &scene, const coupling::PlatenTest &test,
                           const SpecimenState &specimen, double expected_steps, int threads) {
  const dem::Model &model = test.model;
  std::string text =
      fmt::format("{}\n  particles {}, bonds {}, coordination number {:.2f}, packing fraction {:.3f}\n",
                  title_of(scene), model.particles.size(), model.bonds ? model.bonds->initial_count() : 0,
                  test.coordination_number(), test.facts().packing_fraction);
  text += text_of(tiling_of(scene, test.shape())) + text_of(specimen) + text_of_size(scene);
  std::vector<std::string> seats;
  for (const coupling::Side side : coupling::all_sides)
    if (const coupling::Platen *platen = test.platen(side))
      seats.push_back(fmt::format("{} {}", platen->name(), platen->layer().seats()));
  text += fmt::format("  seated spheres: {}\n", fmt::join(seats, ", ")) + text_of_cover(test);
  text += text_of(scene.general.quality, *scene.parameters) + text_of(scene.platens) +
          text_of_layers(scene.platens);
  text += fmt::format("  effects on:  {}\n  effects off: {}\n", fmt::join(effects_on(scene), ", "),
                      fmt::join(effects_off(scene), ", "));
  text += fmt::format("  time step {:.4g} s ({}), {:.0f} steps to the target strain\n", test.time_step(),
                      test.time_step_reason(), expected_steps);
  text += text_of_parts(test);
  if (const double rate = test.axial_rate(); rate > 0) text += fmt::format("  speed {:.4g} m/s\n", rate);
  text += fmt::format("  ramp {:.3g} s, wave crossing {:.3g} s\n", test.ramp(), test.facts().wave_transit);
  return text + fmt::format(
                    "  columns and search {:.1f} MB ({} bytes a particle, {} a bond), instruction set {}, "
                    "threads {}\n",
                    1e-6 * static_cast<double>(test.bytes()), model.particles.table.bytes_per_row(),
                    bytes_per_bond(model), dem::name(model.settings().instruction_set), threads);
}

void RunMessages::observe(const Moment &now) {
  report_misses(reported_, now.ends);
  reported_ = test_.program().stages_ended();
  const dem::Exchange *ranks = std::exchange(ranks_, nullptr);
  if (ranks == nullptr) return;
  log_.info("{}", words_of_cut(*ranks));
  if (const std::string idle = words_of_idle_ranks(*ranks); !idle.empty()) log_.warning("{}", idle);
}

// Of those that are over, but for the first ones.
void RunMessages::report_misses(std::size_t from, bool ended) const {
  for (std::size_t k = from; k < stages_over(test_, ended); ++k) {
    const std::string words = words_of_misses(test_, k);
    if (words.empty()) continue;
    if (failed_in(test_, results_, k))
      log_.info("{} (the specimen failed in it)", words);
    else
      log_.warning("{}", words);
  }
}

void RunMessages::report_path() const {
  const PressurePath path = pressure_path(test_, results_);
  if (path.deviation > most_off_path)
    log_.warning(
        "the pressure was up to {:.1f} % off its path, {:.0f} % at most: a lower Loading/Axial rate helps",
        100 * path.deviation, 100 * most_off_path);
  if (!std::isnan(path.ended_at_strain))
    log_.warning(
        "the pressure had come down to nothing at the strain of {:.5f}: from there on the test goes along "
        "no path, without a pressure",
        path.ended_at_strain);
}

void RunMessages::report_doubts(const Json &summary) const {
  const std::string by = ended_by(scene_, test_, results_);
  if (by == "shortened too far")
    log_.warning(
        "the specimen is shortened by {:.0f} % of its length: the test ends, for what is between the "
        "platens is no specimen of its size any more; a smaller Loading/Target strain ends before",
        100 * std::abs(test_.closure_strain(results_.axis())));
  report_path();
  report_misses(0, !by.empty());
  if (const Json &signs = summary["signs_of_haste"]; !signs.empty())
    log_.warning("too fast to be quasi-static, a lower Loading/Axial rate helps: {}",
                 fmt::join(signs.get<std::vector<std::string>>(), "; "));
  constexpr double most_unbalanced = 0.01; // of the work
  if (const double share = number_in(summary, "platen_unbalanced_work_relative"); share > most_unbalanced)
    log_.warning(
        "platens without inertia are {:.1f} % of the work behind their loads (summary.json, "
        "platen_unbalanced_work_relative), which no more than {:.0f} % should be: "
        "Platens/Motion = explicit, or fewer Platens/Steps per solve",
        100 * share, 100 * most_unbalanced);
  constexpr double most_inertia = 0.15; // of the pressure
  if (const double share = number_in(summary, "tube_inertia_share"); share > most_inertia)
    log_.warning(
        "the inertia of the wall, not its stress, bears {:.0f} % of the pressure on the specimen at the "
        "largest "
        "load (summary.json, tube_inertia_share), {:.0f} % at most: a lower Loading/Axial rate or "
        "Sleeve/Mass scaling helps",
        100 * share, 100 * most_inertia);
  constexpr double small_strain = 0.05;
  if (const double strain = number_in(summary, "platen_plastic_strain"); strain > small_strain)
    log_.warning(
        "platens have yielded by {:.2g} (summary.json, platen_plastic_strain), beyond the small strains of "
        "their law, {:g}: a higher Platens/Yield strength or a smaller Loading/Target strain",
        strain, small_strain);
}

} // namespace platen::apps
