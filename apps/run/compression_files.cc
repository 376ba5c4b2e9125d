// What a test writes while it runs, and what it says beforehand.
#include <fmt/format.h>

#include <cmath>

#include "apps/output/checkpoint_folder.h"
#include "apps/output/crack_discs.h"
#include "apps/run/compression_run.h"
#include "apps/run/problem_setup.h"
#include "apps/run/ranks.h"
#include "apps/run/run_state.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/expect.h"
#include "apps/scene/surfaces.h"
#include "base/pi.h"
#include "base/shortest_text.h"
#include "dem/measure/stress.h"
#include "dem/particles.h"

namespace platen::apps {
namespace {

std::vector<CsvCell> crack_row(const dem::Crack &c) {
  return {c.time,      c.strain,
          c.point.x,   c.point.y,
          c.point.z,   c.normal.x,
          c.normal.y,  c.normal.z,
          c.area,      c.mode == dem::BondState::broken_in_tension ? "tension" : "shear",
          c.energy,    c.particle_a,
          c.particle_b};
}

void require_finite(const dem::Crack &c) {
  const auto sum = [](const Vector3 &v) { return v.x + v.y + v.z; };
  if (!std::isfinite(c.time + c.strain + sum(c.point) + sum(c.normal) + c.area + c.energy))
    throw coupling::NumericsStopped(fmt::format(
        "not finite: place, area or energy of the crack between particles {} and {} at time {} s; "
        "try a smaller `time_step.safety` or `loading.rate`",
        c.particle_a, c.particle_b, shortest_text(c.time)));
}

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

} // namespace

std::string CompressionRun::description() const {
  const dem::Model &model = test_->model;
  const double bonds = model.bonds ? static_cast<double>(model.bonds->initial_count()) : 0.0;
  std::string text = title_of(scene_) + "\n";
  text += fmt::format("  particles {}, bonds {:.0f}, coordination number {:.2f}, packing fraction {:.3f}\n",
                      model.particles.size(), bonds, test_->coordination_number(),
                      test_->facts().packing_fraction);
  text += text_of(tiling_of(scene_, test_->shape()));
  text += text_of(specimen_state_);
  if (const SizeCorrection &size = scene_.bond.size; size.reference > 0 && size.corrects()) {
    const double share = size.share(scene_.specimen);
    text += fmt::format(
        "  bonds for spheres of {:.4g} times the calibrated radius{}: modulus x {:.4f}, "
        "strengths x {:.4f}\n",
        share, size.by_width() ? " over the width" : "", std::pow(share, size.modulus_exponent),
        std::pow(share, size.strength_exponent));
  }
  std::vector<std::string> seats;
  for (const coupling::Side side : coupling::all_sides)
    if (const coupling::Platen *platen = test_->platen(side))
      seats.push_back(fmt::format("{} {}", platen->name(), platen->layer().seats()));
  text += fmt::format("  seated spheres: {}\n", fmt::join(seats, ", "));
  text += text_of_cover(*test_);
  text += text_of(scene_.general.quality, *scene_.parameters);
  text += text_of(scene_.platens);
  text += fmt::format("  effects on:  {}\n  effects off: {}\n", fmt::join(effects_on(scene_), ", "),
                      fmt::join(effects_off(scene_), ", "));
  text += fmt::format("  time step {:.4g} s ({}), {:.0f} steps to the target strain\n", test_->time_step(),
                      test_->time_step_reason(), expected_steps_);
  if (const coupling::SkinPressure *pressed = test_->skin())
    text +=
        fmt::format("  confinement: {} spheres of the skin with {:.3f} of the lateral area, ramp {:.3g} s\n",
                    pressed->skin().size(), pressed->skin().coverage(model.particles, test_->end_planes()),
                    test_->cell_ramp());
  if (const coupling::Sleeve *sleeve = test_->sleeve())
    text += fmt::format(
        "  sleeve: {} elements, {} spheres lie flush with it, stepped once in {}, mass times {:.3g}, ramp "
        "{:.3g} s\n",
        sleeve->solid().mesh().cells.size(), sleeve->layer().seats(),
        sleeve->steps_of_next_interval(test_->time_step()), sleeve->mass_scaling(), test_->cell_ramp());
  if (const coupling::ElasticPlaten *top = test_->elastic_top())
    text += fmt::format("  platens: elastic, {} nodes each, {} of their own steps in a time step\n",
                        top->solid().model().nodes.size(), top->solid().substeps(test_->time_step()));
  if (const double behind = test_->seconds_behind(); behind > 0)
    text += fmt::format("  platens without inertia come {:.3g} s after their loads\n", behind);
  if (const coupling::MachineSpring *machine = test_->machine()) {
    const double k = machine->settings().stiffness, mass = machine->settings().mass;
    text += fmt::format("  machine: a spring of {:.4g} N/m with {:.3g} kg on it, period {:.3g} s\n", k, mass,
                        2 * pi * std::sqrt(mass / k));
  }
  if (const double rate = test_->axial_rate(); rate > 0) text += fmt::format("  speed {:.4g} m/s\n", rate);
  text +=
      fmt::format("  ramp {:.3g} s, wave crossing {:.3g} s\n", test_->ramp(), test_->facts().wave_transit);
  text += fmt::format(
      "  columns and search {:.1f} MB ({} bytes a particle, {} a bond), instruction set {}, threads {}\n",
      1e-6 * static_cast<double>(test_->bytes()), model.particles.table.bytes_per_row(),
      bytes_per_bond(model), dem::name(model.settings().instruction_set), costs().threads);
  return text;
}

void CompressionRun::open_files() {
  const bool in_parallel = output_.threads() > 1; // a run on one thread uses one core
  if (!command_.resume) {
    history_.emplace(paths_.history(), history_names(test_.get()));
    if (scene_.model.crack_log) cracks_.emplace(paths_.cracks(), crack_columns);
    if (scene_.output.fields) fields_.emplace(paths_.folder, in_parallel);
    if (as_packed_) keep(*as_packed_);
    sample();
    if (fields_) fields_->write(*test_, results_.moves_with(*test_));
    return;
  }
  const FoundCheckpoint found = newest_whole_checkpoint(paths_.checkpoints());
  for (const std::string &remark : found.remarks)
    log_.warning("{}", remark);
  const CheckpointReader checkpoint(found.path);
  const FileMarks marks = load_state(checkpoint, *test_, results_);
  if (results_.samples().empty()) checkpoint.fail("\"results/samples\" has no row, one at least is needed");
  if (marks.target_strain != scene_.loading.target_strain) test_->go_on();
  output_.lead_on();
  history_.emplace(paths_.history(), history_names(test_.get()), marks.history_bytes);
  if (scene_.model.crack_log) cracks_.emplace(paths_.cracks(), crack_columns, marks.cracks_bytes);
  if (scene_.output.fields) {
    fields_.emplace(paths_.folder, in_parallel);
    fields_->resume(marks.last_frame, static_cast<int>(marks.frames));
  }
  earlier_seconds_ = marks.wall_seconds;
  first_step_ = test_->steps();
  log_.info("resumed at step {}, time {:.6g} s", test_->steps(), test_->time());
}

void CompressionRun::require_tables(const FileMarks &marks) const {
  require_resumable(paths_.history(), history_names(test_.get()), marks.history_bytes);
  if (scene_.model.crack_log) require_resumable(paths_.cracks(), crack_columns, marks.cracks_bytes);
}

void CompressionRun::sample() {
  dem::StageClock::Lap lap(test_->model.clock, dem::Stage::measures);
  keep((*sampler_)(*test_));
}

void CompressionRun::keep(const Sample &s) {
  history_->row(history_row(s, test_.get()));
  if (results_.falls_with(s)) test_->gather(); // all ranks have the same sample
  const bool fallen = results_.add(s, *test_);
  if (fallen && fields_)
    fields_->write(*test_, results_.moves_with(*test_)); // the state that damage and opening are measured in
  if (listener_) listener_(s);
}

void CompressionRun::write_cracks() {
  for (const dem::Crack &c : test_->model.take_cracks()) {
    require_finite(c);
    cracks_->row(crack_row(c));
    results_.listen(c);
  }
}

void CompressionRun::checkpoint() {
  test_->require_finite(); // or a run would resume from what has stopped it
  history_->sync();
  if (cracks_) cracks_->sync();
  if (fields_) fields_->finish(); // or a run would resume after frames that are not there
  FileMarks marks;
  marks.history_bytes = history_->bytes();
  marks.cracks_bytes = cracks_ ? cracks_->bytes() : 0;
  marks.specimen_sum = specimen_sum_;
  marks.input_sums = output_.inputs().dump();
  marks.last_frame = fields_ ? fields_->last_time() : -1.0;
  marks.frames = fields_ ? fields_->count() : 0;
  marks.wall_seconds = costs().wall_seconds;
  marks.target_strain = scene_.loading.target_strain;
  marks.changes = changes_.empty() ? "" : changes_.dump();
  const auto step = static_cast<std::uint64_t>(test_->steps());
  const auto fill = [&](StateSink &to) { save_state(to, *test_, results_, marks); };
  test_->settle_state();
  if (test_->model.is_cut())
    write_checkpoint_of_ranks(test_->model, specimen_part, paths_.checkpoints(), step, fill);
  else
    write_checkpoint(paths_.checkpoints(), step, fill);
  last_checkpoint_ = Clock::now();
}

// What bonds bear against their direction, and over the axial stress, as the run has left it (Onate et al.
// 2015, figure 11).
void CompressionRun::write_bond_stress() const {
  constexpr int classes = 9;
  const double axial = 0.5 * (test_->stress_top() + test_->stress_bottom());
  WholeTable table(paths_.bond_stress(), {"angle_low_deg", "angle_high_deg", "bonds", "pressed_bonds",
                                          "mean_stress_pa", "mean_pressed_stress_pa", "pressed_over_axial"});
  constexpr double degree = pi / 180;
  for (const dem::DirectionClass &c :
       dem::bond_stress_by_direction(test_->model.particles, *test_->model.bonds, classes))
    table.row({c.low / degree, c.high / degree, c.bonds, c.pressed, c.mean, c.mean_pressed,
               axial != 0 ? c.mean_pressed / axial : not_measured});
  table.finish();
}

dem::EventWindow CompressionRun::event_window() const {
  return dem::event_window(dem::mean_radius(test_->model.particles),
                           test_->shape().height / test_->facts().wave_transit, scene_.output.event_reach,
                           scene_.output.event_time);
}

void CompressionRun::write_events() const {
  WholeTable table(paths_.events(), {"time_s", "duration_s", "x_m", "y_m", "z_m", "size_m", "cracks",
                                     "energy_j", "magnitude"});
  for (const dem::AcousticEvent &e : results_.emission().events)
    table.row(
        {e.time, e.duration, e.centre.x, e.centre.y, e.centre.z, e.size, e.cracks, e.energy, e.magnitude});
  table.finish();
}

Json CompressionRun::summary(const std::string &status) const {
  if (!at_end_.is_null()) return at_end_;
  const RunCosts spent = costs();
  Json made = summary_of_run(status, {scene_, *test_, results_, spent});
  if (!changes_.empty()) made["changes"] = changes_;
  made["expectations"] = unchecked_expectations(scene_, "the test has not come to its end");
  return made;
}

} // namespace platen::apps
