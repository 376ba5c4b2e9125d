#include "apps/run/compression.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>

#include "apps/io/checkpoint_folder.h"
#include "apps/io/csv_writer.h"
#include "apps/io/output_folder.h"
#include "apps/io/progress.h"
#include "apps/io/run_log.h"
#include "apps/io/specimen_csv.h"
#include "apps/io/stop_signal.h"
#include "apps/io/summary.h"
#include "apps/run/estimate.h"
#include "apps/run/expectations.h"
#include "apps/run/fields.h"
#include "apps/run/history.h"
#include "apps/run/problem_setup.h"
#include "apps/run/results.h"
#include "apps/run/run_state.h"
#include "apps/run/specimen_setup.h"
#include "apps/run/summary_of_run.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/scene/version.h"
#include "dem/measure/bond_stress.h"
#include "dem/parallel.h"
#include "fem/threads.h"

namespace platen::apps {
namespace {

using Clock = std::chrono::steady_clock;

// Rows of history.csv and frames for ParaView over the way to the target strain, where the scene leaves it
// open.
constexpr double automatic_rows = 600, automatic_frames = 24;

// Steps between two looks at signals and progress.
constexpr double most_unobserved = 16;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string scene_text(const Scene &scene, const std::filesystem::path &folder) {
  std::ostringstream text;
  write_scene(scene, folder.string(), text);
  return text.str();
}

std::string file_text(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// A resumed run must be the same scene; the first line that differs is named.
void require_same_scene(const Scene &scene, const OutputPaths &paths) {
  std::istringstream before(file_text(paths.scene())), now(scene_text(scene, paths.folder));
  std::string a, b;
  while (true) {
    const bool more_before = static_cast<bool>(std::getline(before, a)),
               more = static_cast<bool>(std::getline(now, b));
    if (!more_before && !more) return;
    if (!more_before) a.clear();
    if (!more) b.clear();
    if (a != b)
      throw InputError(
          fmt::format("{}: the scene has changed since the run that is to be resumed\n  was: {}\n  now: {}\n"
                      "start it anew in another folder, or resume with the scene as it was",
                      paths.scene().string(), a, b));
  }
}

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

enum class Pressed { along_axis, across_axis };

class Test {
public:
  Test(const CommandLine &command, const Scene &scene, Pressed pressed);
  int run();

private:
  std::string description() const;
  double every(const Interval &interval, double automatic) const;
  bool due(const Interval &interval, double automatic) const;
  double steps_until_due(const Interval &interval, double automatic) const;
  long steps_unobserved() const;
  void open_files();
  void loop();
  void sample();
  void write_cracks();
  void checkpoint();
  bool checkpoint_due() const;
  ProgressSample where() const;
  bool finished() const;
  bool by_time() const; // the run ends after a time (hydrostatic: or a little later), not at a strain
  double end_time() const;
  void write_bond_stress() const;
  void save_summary(const std::string &status);
  RunCosts costs() const;

  const CommandLine &command_;
  const Scene &scene_;
  Clock::time_point start_ = Clock::now(), last_checkpoint_ = Clock::now(), loop_start_ = Clock::now();
  OutputPaths paths_;
  RunLog log_;
  dem::ThreadLimit threads_;
  std::unique_ptr<coupling::Problem> problem_;
  std::unique_ptr<Sampler> sampler_;
  Results results_;
  std::optional<CsvWriter> history_, cracks_;
  std::optional<FieldSeries> fields_;
  double setup_seconds_ = 0, earlier_seconds_ = 0;
  double expected_steps_ = 1;
  long first_step_ = 0;
  int signal_ = 0;
  ExtraColumns columns_;
};

// The specimen as the app presses it.
dem::Specimen placed(const Scene &scene, Pressed pressed) {
  const dem::Specimen made = make_specimen(scene);
  const auto refuse = [&](const std::string &reason) {
    if (scene.parameters) scene.parameters->refuse("Specimen/File", reason);
    throw InputError("Specimen/File " + reason);
  };
  if (pressed == Pressed::across_axis) {
    if (made.shape.kind == dem::ShapeKind::box)
      refuse("states a box, which cannot be laid on its rim. Allowed: a cylinder, a disc.");
    return dem::laid_down(made);
  }
  if (scene.loading.bending() && scene.specimen.shape == SpecimenShape::bar) return dem::laid_along_x(made);
  if (made.shape.kind == dem::ShapeKind::disc)
    refuse("states a disc that lies on its rim, for platen-brazilian. Allowed: a cylinder, a box.");
  return made;
}

Loudness loudness(const CommandLine &c) {
  return c.quiet ? Loudness::quiet : (c.verbose ? Loudness::verbose : Loudness::normal);
}

Test::Test(const CommandLine &command, const Scene &scene, Pressed pressed)
    : command_(command),
      scene_(scene),
      paths_(command.output),
      log_(loudness(command)),
      threads_(command.threads),
      results_(scene.loading.test == LoadingTest::tension),
      columns_{scene.loading.cell(), pressed == Pressed::across_axis, scene.loading.bending()} {
  fem::limit_threads(command.threads);
  const FolderUse use =
      command.resume ? FolderUse::resume : (command.overwrite ? FolderUse::overwrite : FolderUse::fresh);
  std::vector<std::filesystem::path> inputs{command.scene};
  if (!scene.specimen.file.empty()) inputs.emplace_back(scene.specimen.file);
  if (!scene.phases.file.empty()) inputs.emplace_back(scene.phases.file);
  if (!command.dry_run) check_output_folder(paths_.folder, use, inputs);
  if (command.resume && !command.dry_run) require_same_scene(scene, paths_);
  // A resumed run takes the packing that the first part wrote, to the last bit.
  const dem::Specimen specimen = command.resume && !command.dry_run
                                     ? read_specimen_csv(paths_.specimen_csv()).specimen
                                     : placed(scene, pressed);
  try {
    problem_ = std::make_unique<coupling::Problem>(specimen, problem_settings(scene));
    sampler_ = std::make_unique<Sampler>(*problem_);
  } catch (const coupling::BadSetup &e) {
    if (scene.parameters) scene.parameters->refuse(e.entry(), e.what());
    throw InputError(e.entry() + " " + e.what());
  }
  const double seconds =
      by_time()
          ? end_time()
          : (columns_.confined ? problem_->cell_ramp() + scene.loading.hold : 0.0) + 0.5 * problem_->ramp() +
                scene.loading.target_strain * problem_->shape().height / scene.loading.axial_rate;
  expected_steps_ = std::max(1.0, seconds / problem_->time_step());
  setup_seconds_ = seconds_since(start_);
  if (command.dry_run) return;
  catch_stop_signals(); // before the first byte is written: from here on a stop leaves a checkpoint
  open_output_folder(paths_.folder, use, inputs);
  log_.open(paths_.log(), command.resume, {version_text(), command.text, costs().threads});
  if (!command.resume) {
    write_text_aside(paths_.scene(), scene_text(scene, paths_.folder));
    write_specimen_csv(paths_.specimen_csv(), specimen);
  }
}

RunCosts Test::costs() const {
  RunCosts c;
  c.threads = command_.threads > 0 ? command_.threads : dem::hardware_threads();
  c.wall_seconds = earlier_seconds_ + seconds_since(start_);
  c.setup_seconds = setup_seconds_;
  c.steps_here = problem_->steps() - first_step_;
  c.step_seconds = seconds_since(loop_start_);
  return c;
}

std::string Test::description() const {
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
  text += fmt::format("  effects on:  {}\n  effects off: {}\n", on, off);
  text += fmt::format("  time step {:.4g} s ({}), {:.0f} steps to the target strain\n", problem_->time_step(),
                      problem_->time_step_reason(), expected_steps_);
  if (columns_.confined)
    text += fmt::format(
        "  confinement: {} spheres of the skin with {:.3f} of the lateral area, ramp {:.3g} s\n",
        problem_->confinement()->size(),
        problem_->confinement()->coverage(model.particles, problem_->end_planes()), problem_->cell_ramp());
  text +=
      fmt::format("  ramp {:.3g} s, wave crossing {:.3g} s\n", problem_->ramp(), problem_->wave_crossing());
  text += fmt::format(
      "  columns and search {:.1f} MB ({} bytes a particle, {} a bond), instruction set {}, threads {}\n",
      1e-6 * static_cast<double>(problem_->bytes()), model.particles.table.bytes_per_row(),
      bytes_per_bond(model), dem::name(model.settings().instruction_set), costs().threads);
  return text;
}

// Steps from one look to the next: as given, or `automatic` looks on the way to the target.
double Test::every(const Interval &interval, double automatic) const {
  const double every =
      interval.kind == Interval::Kind::steps ? interval.value : std::ceil(expected_steps_ / automatic);
  return std::max(1.0, every);
}

// Steps: every n-th. Times: the first step at or after each multiple. Neither: `automatic` of them on the
// way.
bool Test::due(const Interval &interval, double automatic) const {
  if (interval.kind == Interval::Kind::time)
    return std::floor(problem_->time() / interval.value) >
           std::floor((problem_->time() - problem_->time_step()) / interval.value);
  return std::fmod(static_cast<double>(problem_->steps()), every(interval, automatic)) == 0;
}

// A lower bound; 1 at least.
double Test::steps_until_due(const Interval &interval, double automatic) const {
  if (interval.kind == Interval::Kind::time)
    return (1 - std::fmod(problem_->time() / interval.value, 1.0)) * interval.value / problem_->time_step() -
           1;
  const double n = every(interval, automatic);
  return n - std::fmod(static_cast<double>(problem_->steps()), n);
}

// Steps that can be made before output, checkpoint or the end of the test is looked at.
long Test::steps_unobserved() const {
  const coupling::Problem &p = *problem_;
  double steps = steps_until_due(scene_.output.every, automatic_rows);
  if (fields_) steps = std::min(steps, steps_until_due(scene_.output.fields_every, automatic_frames));
  if (scene_.checkpoint.every.kind == Interval::Kind::steps)
    steps = std::min(steps, steps_until_due(scene_.checkpoint.every, 1));
  if (!scene_.loading.hydrostatic()) {
    const double step_closes = scene_.loading.axial_rate * p.time_step() / p.shape().height;
    steps = std::min(steps, (scene_.loading.target_strain - std::abs(p.closure_strain())) / step_closes - 1);
  }
  if (by_time()) steps = std::min(steps, (end_time() - p.time()) / p.time_step() - 1);
  return static_cast<long>(std::clamp(steps, 1.0, most_unobserved));
}

void Test::open_files() {
  if (!command_.resume) {
    history_.emplace(paths_.history(), history_columns(columns_));
    if (scene_.effects.crack_log) cracks_.emplace(paths_.cracks(), crack_columns);
    if (scene_.output.fields) fields_.emplace(paths_.folder);
    sample();
    if (fields_) fields_->write(*problem_);
    return;
  }
  const FoundCheckpoint found = newest_whole_checkpoint(paths_.checkpoints());
  for (const std::string &remark : found.remarks)
    log_.warning("{}", remark);
  const FileMarks marks = load_state(CheckpointReader(found.path), *problem_, results_);
  history_.emplace(paths_.history(), history_columns(columns_), marks.history_bytes);
  if (scene_.effects.crack_log) cracks_.emplace(paths_.cracks(), crack_columns, marks.cracks_bytes);
  if (scene_.output.fields) {
    fields_.emplace(paths_.folder);
    fields_->resume(marks.last_frame, static_cast<int>(marks.frames));
  }
  earlier_seconds_ = marks.wall_seconds;
  first_step_ = problem_->steps();
  log_.info("resumed at step {}, time {:.6g} s", problem_->steps(), problem_->time());
}

void Test::sample() {
  dem::StageClock::Lap lap(problem_->model.clock, dem::Stage::measures);
  const Sample s = (*sampler_)(*problem_);
  history_->row(history_row(s, columns_));
  const bool fallen = results_.add(s, *problem_);
  if (fallen && fields_) fields_->write(*problem_); // the state that damage and opening are measured in
}

void Test::write_cracks() {
  for (const dem::Crack &c : problem_->model.take_cracks())
    cracks_->row(crack_row(c, problem_->closure_strain()));
}

void Test::checkpoint() {
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

bool Test::checkpoint_due() const {
  const Interval &every = scene_.checkpoint.every;
  if (every.kind == Interval::Kind::time) return seconds_since(last_checkpoint_) > every.value;
  return every.kind == Interval::Kind::steps &&
         std::fmod(static_cast<double>(problem_->steps()), every.value) == 0;
}

bool Test::by_time() const {
  return scene_.platens.top_control == PlatenControl::stress || scene_.loading.hydrostatic();
}

double Test::end_time() const {
  return (scene_.loading.hydrostatic() ? problem_->cell_ramp() : problem_->ramp()) + scene_.loading.hold;
}

bool Test::finished() const {
  if (scene_.loading.hydrostatic()) return problem_->axial_stage();
  if (by_time() && problem_->time() >= end_time()) return true;
  if (std::abs(problem_->closure_strain()) >= scene_.loading.target_strain) return true;
  return scene_.loading.stop_at_residual > 0 && results_.fallen_to(scene_.loading.stop_at_residual);
}

ProgressSample Test::where() const {
  ProgressSample p;
  p.fraction = std::min(1.0, by_time() ? problem_->time() / end_time()
                                       : std::abs(problem_->closure_strain()) / scene_.loading.target_strain);
  p.step = static_cast<std::uint64_t>(problem_->steps());
  p.time = problem_->time();
  p.strain = problem_->closure_strain();
  p.stress = 0.5 * (problem_->stress_top() + problem_->stress_bottom());
  p.broken_bonds = problem_->model.broken_tension + problem_->model.broken_shear;
  return p;
}

void Test::loop() {
  Progress progress(log_);
  loop_start_ = Clock::now();
  while (!finished()) {
    problem_->advance(steps_unobserved());
    if (!problem_->model.cracks.empty()) write_cracks();
    if (due(scene_.output.every, automatic_rows)) sample();
    if (fields_ && due(scene_.output.fields_every, automatic_frames)) {
      dem::StageClock::Lap lap(problem_->model.clock, dem::Stage::output);
      fields_->write(*problem_);
    }
    signal_ = stop_requested();
    if (signal_ != 0 || checkpoint_due() || take_checkpoint_request()) {
      dem::StageClock::Lap lap(problem_->model.clock, dem::Stage::output);
      checkpoint();
    }
    if (signal_ != 0) break;
    if (progress.due()) progress.update(where());
  }
  progress.finish(where());
}

void Test::save_summary(const std::string &status) {
  write_summary(paths_.summary(), summary_of_run(status, scene_, *problem_, results_, costs()));
}

// What bonds bear against their direction, and over the axial stress, as the run has left it (Onate et al.
// 2015, figure 11).
void Test::write_bond_stress() const {
  constexpr int classes = 9;
  const double axial = 0.5 * (problem_->stress_top() + problem_->stress_bottom());
  CsvWriter table(paths_.bond_stress(), {"angle_low_deg", "angle_high_deg", "bonds", "pressed_bonds",
                                         "mean_stress_pa", "mean_pressed_stress_pa", "pressed_over_axial"});
  constexpr double degree = 3.14159265358979323846 / 180;
  for (const dem::DirectionClass &c :
       dem::bond_stress_by_direction(problem_->model.particles, *problem_->model.bonds, classes))
    table.row({c.low / degree, c.high / degree, c.bonds, c.pressed, c.mean, c.mean_pressed,
               c.mean_pressed / axial});
}

int Test::run() {
  if (command_.dry_run) {
    fmt::print("{}{}", description(), cost_estimate(*problem_, expected_steps_));
    return status_done;
  }
  log_.info("{}", description());
  open_files();
  try {
    loop();
  } catch (const coupling::NumericsStopped &e) {
    save_summary("failed");
    std::error_code ignored;
    const bool kept = std::filesystem::exists(paths_.checkpoints(), ignored);
    throw NumericsError(fmt::format("{}\n{}", e.what(),
                                    kept ? "the last checkpoint is in " + paths_.checkpoints().string()
                                         : "no checkpoint had been written"));
  }
  results_.finish(*problem_);
  if (problem_->model.bonds) write_bond_stress();
  if (fields_) fields_->write(*problem_);
  save_summary(signal_ != 0 ? "stopped" : "done");
  log_.info("{}", report_of_run(scene_, *problem_, results_, costs()));
  if (signal_ != 0) {
    log_.info("stopped by a signal; go on with: {} {} -o {} --resume", app_of(*problem_), command_.scene,
              command_.output);
    return exit_status_of_signal(signal_);
  }
  log_.info("results are in {}", paths_.folder.string());
  return tell_expectations(scene_, summary_of_run("done", scene_, *problem_, results_, costs()), log_);
}

} // namespace

int run_compression(const CommandLine &command, const Scene &scene) {
  return Test(command, scene, Pressed::along_axis).run();
}

int run_brazilian(const CommandLine &command, const Scene &scene) {
  return Test(command, scene, Pressed::across_axis).run();
}

} // namespace platen::apps
