#include "apps/bar/run_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/bar/bar_results.h"
#include "apps/output/progress.h"
#include "apps/output/stop_signal.h"
#include "apps/run/app_output.h"
#include "apps/run/model_setup.h"
#include "apps/run/packing_cache.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/expect.h"

namespace platen::apps {
namespace {

// Unless the scene says how often.
constexpr double samples_per_period = 64, samples_of_an_impact = 400;

std::vector<BarLoad> loads_of(const BarTest &test) {
  if (test.load == BarLoad::none) return {};
  if (test.load != BarLoad::all) return {test.load};
  std::vector<BarLoad> all{BarLoad::tension, BarLoad::bending, BarLoad::torsion};
  if (test.method != BarMethod::at_rest) all.push_back(BarLoad::impact);
  return all;
}

class BarRun {
public:
  BarRun(const Scene &scene, AppOutput &output, bool writes)
      : scene_(scene),
        output_(output),
        specimen_(make_bonded_specimen(scene, keep_in_cache(scene, writes, output.log))),
        settings_(model_settings(scene)),
        model_(specimen_, settings_) {}

  void measure();
  std::string description() const;
  int carry_out();

private:
  void test(BarLoad load);
  void strike_bar();
  bool dynamic() const { return bar_test_of(scene_).method != BarMethod::at_rest; }
  Clocking clocking(BarLoad load) const;
  bool take(const BarSample &sample, BarLoad load);
  void finish(const dem::Model &model, const Motion &motion);

  const Scene &scene_;
  AppOutput &output_;
  dem::Specimen specimen_;
  dem::ModelSettings settings_;
  dem::Model model_; // at rest
  BarResults results_;
  std::unique_ptr<CsvWriter> history_;
  std::unique_ptr<Progress> progress_;
  long planned_ = 0;
  int signal_ = 0;
};

void BarRun::measure() {
  if (model_.bonds->size() == 0) refuse(scene_, "Bond/Gap", "bonds no two spheres of this specimen.");
  BarResults &r = results_;
  r.particles = model_.particles.size();
  r.bonds = model_.bonds->size();
  r.packing_fraction = volume_of_spheres(specimen_) / specimen_.shape.volume();
  r.bar = measure_bar(model_.particles, *model_.bonds, specimen_.shape, bar_test_of(scene_).end_depth,
                      bar_test_of(scene_).side == BarSide::x);
  r.pulled = pull_bar(model_, r.bar, specimen_.shape);
  if (!(r.pulled.axial_rigidity > 0))
    refuse(scene_, "Specimen/Height",
           "leaves too few spheres in the middle half of the bar to tell a strain, or the "
           "spheres do not hold together.");
  r.youngs_modulus = r.pulled.axial_rigidity / r.bar.bounding.area();
  r.poisson_ratio = r.pulled.poisson_ratio;
  r.bulk = {not_given, not_given, not_given};
  if (dynamic()) r.time = bar_time_step(scene_, model_);
  r.time_step = r.time.step;
  r.time_step_reason = r.time.reason;
  if (dynamic())
    for (const BarLoad load : loads_of(bar_test_of(scene_)))
      planned_ += clocking(load).steps;
}

// How its motion is stepped and sampled.
Clocking BarRun::clocking(BarLoad load) const {
  const double step = results_.time.of(load);
  const bool struck = load == BarLoad::impact;
  const double frequency = struck ? 0 : results_.oscillating_rod(true).frequency(load);
  const long steps = static_cast<long>(
      std::ceil(struck ? followed_passages * results_.bar.length() / (results_.rod(false).wave_speed() * step)
                       : bar_test_of(scene_).periods / (frequency * step)));
  const double interval = struck ? step * static_cast<double>(steps) / samples_of_an_impact
                                 : 1 / (samples_per_period * frequency);
  const Interval &every = scene_.output.every;
  const double between = every.kind == Interval::Kind::steps  ? every.value
                         : every.kind == Interval::Kind::time ? every.value / step
                                                              : interval / step;
  return {step, steps, std::max(1L, static_cast<long>(between))};
}

std::string BarRun::description() const {
  const BarResults &r = results_;
  const CrossSection &b = r.bar.bounding;
  std::string text = title_of(scene_);
  text += fmt::format("\n  {} spheres of mean radius {:.4g} mm, {} bonds, packing fraction {:.4f}\n",
                      r.particles, 1e3 * r.bar.mean_radius, r.bonds, r.packing_fraction);
  text += fmt::format("  length {:.4g} mm, ", 1e3 * r.bar.length());
  text +=
      b.round
          ? fmt::format("radius {:.4g} mm, effective {:.4g} mm", 1e3 * b.radius, 1e3 * r.bar.effective.radius)
          : fmt::format("widths {:.4g} x {:.4g} mm, effective {:.4g} x {:.4g} mm", 1e3 * b.width_x,
                        1e3 * b.width_y, 1e3 * r.bar.effective.width_x, 1e3 * r.bar.effective.width_y);
  text += fmt::format("; {} spheres clamped, {} loaded\n", r.bar.low.rows.size(), r.bar.high.rows.size());
  if (planned_ > 0)
    text += fmt::format("  {} steps of {:.4g} s ({})\n", planned_, r.time.step, r.time.reason);
  return text;
}

bool BarRun::take(const BarSample &s, BarLoad load) {
  history_->row(bar_row(s, load, results_, scene_.model.energy_ledger));
  ProgressSample p;
  const double made = static_cast<double>(results_.steps) + s.time / results_.time.of(load);
  p.fraction = made / static_cast<double>(planned_);
  p.step = static_cast<std::uint64_t>(made + 0.5);
  p.time = s.time;
  p.broken_bonds = s.broken_tension + s.broken_shear;
  progress_->update(p);
  signal_ = stop_requested();
  return signal_ == 0;
}

void BarRun::finish(const dem::Model &model, const Motion &motion) {
  results_.TestFigures::add(model, motion.steps);
  if (results_.steps > 0) results_.energy_residual.add(motion.energy_residual.value());
}

void BarRun::test(BarLoad load) {
  if (load == BarLoad::impact) return strike_bar();
  const BarTest &test = bar_test_of(scene_);
  const StaticTest at_rest =
      load_bar(model_, results_.bar, load, results_.rod(false).load_of_strain(load, test.strain));
  if (test.method != BarMethod::dynamic) results_.add(load, at_rest);
  if (!dynamic()) return;
  dem::Model oscillating(specimen_, settings_);
  const double expected = results_.oscillating_rod(true).frequency(load);
  const Oscillation oscillation = release(oscillating, results_.bar, load, at_rest.state, expected,
                                          clocking(load), [&](const BarSample &s) { return take(s, load); });
  results_.add(load, oscillation);
  finish(oscillating, oscillation);
}

void BarRun::strike_bar() {
  dem::Model struck(specimen_, settings_);
  const double speed = results_.rod(false).wave_speed(), velocity = bar_test_of(scene_).strain * speed;
  const Impact impact = strike(struck, results_.bar, velocity, speed, clocking(BarLoad::impact),
                               [&](const BarSample &s) { return take(s, BarLoad::impact); });
  results_.add(impact, velocity);
  finish(struck, impact);
}

int BarRun::carry_out() {
  results_.threads = output_.threads();
  results_.setup_seconds = output_.seconds();
  catch_stop_signals();
  output_.open();
  output_.log.info("{}", description());
  history_ = std::make_unique<CsvWriter>(output_.paths.history(), bar_columns());
  progress_ = std::make_unique<Progress>(output_.log);
  if (bar_test_of(scene_).bulk_moduli) results_.bulk = bulk_moduli(model_, results_.bar, specimen_.shape);
  for (const BarLoad load : loads_of(bar_test_of(scene_)))
    if (signal_ == 0) test(load);
  progress_.reset();
  results_.wall_seconds = output_.seconds();
  if (results_.broken_tension + results_.broken_shear > 0)
    output_.log.warning(
        "{} bonds broke: the bar is not the one that strength of materials speaks of; a smaller Bar "
        "test/Strain keeps it whole",
        results_.broken_tension + results_.broken_shear);
  Json summary = summary_of(scene_, results_, signal_ != 0 ? "stopped" : "done");
  const std::string report = report_of(results_);
  if (signal_ != 0) {
    summary["expectations"] = unchecked_expectations(scene_, "the test has not come to its end");
    output_.save(summary);
    output_.log.info("{}\nstopped by a signal; a bar test keeps no checkpoint", report);
    return exit_status_of_signal(signal_);
  }
  return output_.finish(summary, fmt::format("{}\n  {:.1f} s; results are in {}", report,
                                             results_.wall_seconds, output_.paths.folder.string()));
}

} // namespace

int run_bar(const CommandLine &command, const Scene &scene) {
  if (command.resume)
    throw InputError("command line: --resume: a bar test takes minutes and keeps no checkpoint; run it anew");
  AppOutput output(command, scene);
  BarRun run(scene, output, !command.dry_run);
  run.measure();
  if (command.dry_run) {
    fmt::print("{}", run.description());
    return status_done;
  }
  return run.carry_out();
}

} // namespace platen::apps
