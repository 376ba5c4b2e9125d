// What a test writes while it runs, and what it says beforehand.
#include <fmt/format.h>

#include "apps/io/checkpoint_folder.h"
#include "apps/io/summary.h"
#include "apps/run/compression_run.h"
#include "apps/run/problem_setup.h"
#include "apps/run/run_state.h"
#include "apps/scene/surfaces.h"
#include "dem/mean_radius.h"
#include "dem/measure/bond_stress.h"
#include "fem/elastic_solid.h"

namespace platen::apps {
namespace {

std::vector<CsvCell> crack_row(const dem::Crack &c, double strain) {
  return {c.time,      strain,
          c.point.x,   c.point.y,
          c.point.z,   c.normal.x,
          c.normal.y,  c.normal.z,
          c.area,      c.mode == dem::BondState::broken_in_tension ? "tension" : "shear",
          c.energy,    c.particle_a,
          c.particle_b};
}

const std::vector<std::string> crack_columns{"time_s",   "axial_strain", "x_m",       "y_m",     "z_m",
                                             "nx",       "ny",           "nz",        "area_m2", "mode",
                                             "energy_j", "particle_a",   "particle_b"};

} // namespace

std::string CompressionRun::description() const {
  const dem::Model &model = problem_->model;
  std::string on, off;
  for (const std::string &word : effects_on(scene_))
    on += (on.empty() ? "" : ", ") + word;
  for (const std::string &word : effects_off(scene_))
    off += (off.empty() ? "" : ", ") + word;
  const double bonds = model.bonds ? static_cast<double>(model.bonds->initial_count()) : 0.0;
  std::string text = fmt::format("{}\n", scene_.general.title.empty() ? scene_.name : scene_.general.title);
  text += fmt::format("  particles {}, bonds {:.0f}, coordination number {:.2f}, packing fraction {:.3f}\n",
                      model.particles.size(), bonds, problem_->coordination_number(),
                      problem_->packing_fraction());
  text += fmt::format("  seated spheres: bottom {}, top {}\n", problem_->bottom_layer.seats(),
                      problem_->top_layer.seats());
  text += text_of(scene_.general.quality, *scene_.parameters);
  text += text_of(scene_.platens);
  text += fmt::format("  effects on:  {}\n  effects off: {}\n", on, off);
  text += fmt::format("  time step {:.4g} s ({}), {:.0f} steps to the target strain\n", problem_->time_step(),
                      problem_->time_step_reason(), expected_steps_);
  if (const dem::Confinement *skin = problem_->confinement())
    text += fmt::format(
        "  confinement: {} spheres of the skin with {:.3f} of the lateral area, ramp {:.3g} s\n",
        skin->size(), skin->coverage(model.particles, problem_->end_planes()), problem_->cell_ramp());
  if (const coupling::Sleeve *sleeve = problem_->sleeve())
    text += fmt::format(
        "  sleeve: {} elements, {} spheres lie flush with it, stepped once in {}, mass times {:.3g}, ramp "
        "{:.3g} s\n",
        sleeve->solid.mesh().cells.size(), sleeve->layer.seats(),
        sleeve->steps_of_next_interval(problem_->time_step()), sleeve->mass_scaling(), problem_->cell_ramp());
  if (const auto *top = dynamic_cast<const fem::ElasticSolid *>(&problem_->top))
    text += fmt::format("  platens: elastic, {} nodes each, {} of their own steps in a time step\n",
                        top->model().nodes.size(), top->substeps(problem_->time_step()));
  if (const double rate = problem_->axial_rate(); rate > 0) text += fmt::format("  speed {:.4g} m/s\n", rate);
  text +=
      fmt::format("  ramp {:.3g} s, wave crossing {:.3g} s\n", problem_->ramp(), problem_->wave_crossing());
  text += fmt::format(
      "  columns and search {:.1f} MB ({} bytes a particle, {} a bond), instruction set {}, threads {}\n",
      1e-6 * static_cast<double>(problem_->bytes()), model.particles.table.bytes_per_row(),
      bytes_per_bond(model), dem::name(model.settings().instruction_set), costs().threads);
  return text;
}

void CompressionRun::open_files() {
  if (!command_.resume) {
    history_.emplace(paths_.history(), history_columns(columns_));
    if (scene_.model.crack_log) cracks_.emplace(paths_.cracks(), crack_columns);
    if (scene_.output.fields) fields_.emplace(paths_.folder);
    if (as_packed_) keep(*as_packed_);
    sample();
    if (fields_) fields_->write(*problem_);
    return;
  }
  const FoundCheckpoint found = newest_whole_checkpoint(paths_.checkpoints());
  for (const std::string &remark : found.remarks)
    log_.warning("{}", remark);
  const FileMarks marks = load_state(CheckpointReader(found.path), *problem_, results_);
  history_.emplace(paths_.history(), history_columns(columns_), marks.history_bytes);
  if (scene_.model.crack_log) cracks_.emplace(paths_.cracks(), crack_columns, marks.cracks_bytes);
  if (scene_.output.fields) {
    fields_.emplace(paths_.folder);
    fields_->resume(marks.last_frame, static_cast<int>(marks.frames));
  }
  earlier_seconds_ = marks.wall_seconds;
  first_step_ = problem_->steps();
  log_.info("resumed at step {}, time {:.6g} s", problem_->steps(), problem_->time());
}

void CompressionRun::sample() {
  dem::StageClock::Lap lap(problem_->model.clock, dem::Stage::measures);
  keep((*sampler_)(*problem_));
}

void CompressionRun::keep(const Sample &s) {
  history_->row(history_row(s, columns_));
  const bool fallen = results_.add(s, *problem_);
  if (fallen && fields_) fields_->write(*problem_); // the state that damage and opening are measured in
}

void CompressionRun::write_cracks() {
  for (const dem::Crack &c : problem_->model.take_cracks()) {
    cracks_->row(crack_row(c, problem_->closure_strain()));
    results_.listen(c);
  }
}

void CompressionRun::checkpoint() {
  problem_->require_finite(); // or a run would resume from what has stopped it
  history_->sync();
  if (cracks_) cracks_->sync();
  FileMarks marks;
  marks.history_bytes = history_->bytes();
  marks.cracks_bytes = cracks_ ? cracks_->bytes() : 0;
  marks.last_frame = fields_ ? fields_->last_time() : -1.0;
  marks.frames = fields_ ? fields_->count() : 0;
  marks.wall_seconds = costs().wall_seconds;
  write_checkpoint(paths_.checkpoints(), static_cast<std::uint64_t>(problem_->steps()),
                   [&](CheckpointWriter &to) { save_state(to, *problem_, results_, marks); });
  last_checkpoint_ = Clock::now();
}

// What bonds bear against their direction, and over the axial stress, as the run has left it (Onate et al.
// 2015, figure 11).
void CompressionRun::write_bond_stress() const {
  constexpr int classes = 9;
  const double axial = 0.5 * (problem_->stress_top() + problem_->stress_bottom());
  WholeTable table(paths_.bond_stress(), {"angle_low_deg", "angle_high_deg", "bonds", "pressed_bonds",
                                          "mean_stress_pa", "mean_pressed_stress_pa", "pressed_over_axial"});
  constexpr double degree = 3.14159265358979323846 / 180;
  for (const dem::DirectionClass &c :
       dem::bond_stress_by_direction(problem_->model.particles, *problem_->model.bonds, classes))
    table.row({c.low / degree, c.high / degree, c.bonds, c.pressed, c.mean, c.mean_pressed,
               c.mean_pressed / axial});
  table.finish();
}

dem::EventWindow CompressionRun::event_window() const {
  return dem::event_window(dem::mean_radius(problem_->model.particles),
                           problem_->shape().height / problem_->wave_crossing(), scene_.output.event_reach,
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

void CompressionRun::save_summary(const std::string &status) {
  write_summary(paths_.summary(), summary_of_run(status, scene_, *problem_, results_, costs()));
}

} // namespace platen::apps
