// A test as it begins: the specimen laid as the app presses it, its problem, its folder; anew or resumed.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/output/checkpoint_folder.h"
#include "apps/output/sha256.h"
#include "apps/output/specimen_csv.h"
#include "apps/output/stop_signal.h"
#include "apps/run/compression_run.h"
#include "apps/run/needs.h"
#include "apps/run/packing_cache.h"
#include "apps/run/problem_setup.h"
#include "apps/run/ranks.h"
#include "apps/run/run_state.h"
#include "apps/run/specimen_check.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/parameters.h"
#include "apps/scene/rank.h"
#include "coupling/program_of_test.h"
#include "coupling/static_press.h"

namespace platen::apps {
namespace {

// The specimen as the app presses it.
dem::Specimen placed(const Scene &scene, Pressed pressed, const KeepPacking &keep) {
  const dem::Specimen made = make_bonded_specimen(scene, keep);
  const auto refuse = [&](const std::string &reason) { apps::refuse(scene, "Specimen/File", reason); };
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

// The shape of a specimen that is to be packed, as the app presses it.
dem::Shape as_pressed(const dem::Shape &shape, const Scene &scene, Pressed pressed) {
  dem::Specimen empty;
  empty.shape = shape;
  if (pressed == Pressed::across_axis && shape.kind != dem::ShapeKind::box)
    return dem::laid_down(empty).shape;
  const bool lies = scene.loading.bending() && scene.specimen.shape == SpecimenShape::bar;
  return lies ? dem::laid_along_x(empty).shape : shape;
}

// Wave transits of the height within which platens without inertia have to follow their loads along their
// way. A specimen that breaks sheds its load within a few; what comes later is too soft beside its contacts
// to be solved for now and then, and most so across, where a sheet is pressed out.
constexpr double latest_by_transits = 15;

void require_prompt_platens(const coupling::PlatenTest &test) {
  const double behind = test.seconds_behind(), transit = test.facts().wave_transit;
  if (!(transit > 0) || behind <= latest_by_transits * transit) return;
  throw coupling::BadSetup(
      "platens.elastic.motion",
      fmt::format(
          "comes {:.3g} s after its loads, being softer than the contacts on it, while a wave crosses "
          "the specimen in {:.3g} s: up to {:.0f} times that. Allowed: explicit, or fewer "
          "`platens.elastic.steps_per_solve`.",
          behind, transit, latest_by_transits));
}

// The packing that the first part wrote; the list of ids may have changed since.
dem::Specimen resumed(const Scene &scene, const OutputPaths &paths) {
  dem::Specimen specimen = read_specimen_csv(paths.specimen_csv()).specimen;
  check_phases(scene, specimen);
  return specimen;
}

// The packing is kept whole; the specimen.csv of a resumed run lacks the spheres already.
dem::Specimen notched(const Scene &scene, const dem::Specimen &whole) {
  const dem::Notch &notch = scene.specimen.notch;
  if (notch.is_there() && whole.shape.kind != dem::ShapeKind::box)
    refuse(scene, "Specimen/Notch depth", "is of bars that are bent in three points. Allowed: 0.");
  return dem::notched(whole, notch);
}

} // namespace

CompressionRun::CompressionRun(const CommandLine &command, const Scene &scene, Pressed pressed)
    : command_(command),
      scene_(scene),
      resumes_(command.resume && !command.dry_run),
      output_(command, scene, true) {
  require_same_on_ranks(scene_text(scene, paths_.folder));
  const FileMarks marks = resumes_ ? marks_of_checkpoint() : FileMarks{};
  const bool packs = !resumes_ && scene.specimen.packing != PackingKind::file;
  if (packs) require_memory(as_pressed(specimen_shape(scene), scene, pressed));
  if (!counted_.empty()) return;
  // A resumed run takes the packing that the first part wrote, to the last bit.
  const auto keep = [&] {
    return keep_packing(command, scene, !command.dry_run && !this_rank().is_silent(), log_);
  };
  const dem::Specimen whole = resumes_ ? resumed(scene, paths_) : placed(scene, pressed, keep());
  const bool bends = pressed == Pressed::along_axis; // a disc has no notch, whatever its scene says
  const dem::Specimen specimen = bends ? notched(scene, whole) : whole;
  require_spheres(scene, specimen);
  if (!packs) require_memory(specimen.shape);
  if (counted_.empty()) set_up(specimen, marks);
}

void CompressionRun::set_up(const dem::Specimen &specimen, const FileMarks &marks) {
  coupling::PlatenTestSettings settings = problem_settings(scene_);
  if (resumes_)
    settings.model.instruction_set =
        resumed_instruction_set(CheckpointReader(newest_whole_checkpoint(paths_.checkpoints()).path), log_);
  std::unique_ptr<dem::Exchange> exchange = command_.dry_run ? nullptr : exchange_of_ranks();
  const CommonSet common = common_instruction_set(settings.model.instruction_set, exchange.get(), resumes_);
  settings.model.instruction_set = common.set;
  if (!common.note.empty()) log_.warning("{}", common.note);
  test_ = std::make_unique<coupling::PlatenTest>(specimen, settings);
  require_prompt_platens(*test_);
  specimen_state_ = state_of(scene_, specimen, *test_);
  require_specimen(scene_, specimen_state_);
  results_ = Results(scene_.loading.test == LoadingTest::tension, {scene_.output.sound_share},
                     coupling::loaded_axis(*test_), measures_pattern(scene_, *test_));
  Sampler sampler(*test_);
  if (scene_.loading.start_strain > 0 && !resumes_) {
    as_packed_ = sampler(*test_); // from which moduli and strains are read
    start_pressed();
  }
  expected_steps_ = std::max(1.0, test_->program().expected_seconds() / test_->time_step());
  require_length();
  record_.emplace(scene_, *test_, results_, paths_, std::move(sampler), expected_steps_);
  setup_seconds_ = output_.seconds();
  if (command_.dry_run) return;
  if (resumes_)
    record_->require_tables(marks, newest_whole_checkpoint(paths_.checkpoints()).path.filename().string());
  if (exchange) {
    ranks_ = exchange.get();
    ranks_->largest(0); // nothing is written while another rank still reads what an earlier part has left
    test_->share(std::move(exchange));
  }
  catch_stop_signals(); // before the first byte is written: from here on a stop leaves a checkpoint
  output_.open();
  if (!resumes_) write_specimen_csv(paths_.specimen_csv(), specimen);
  specimen_sum_ = sha256_of_file(paths_.specimen_csv()).value_or("");
}

// Of the newest checkpoint, if the files that the test is made from are still those of it.
FileMarks CompressionRun::marks_of_checkpoint() {
  const CheckpointReader checkpoint(newest_whole_checkpoint(paths_.checkpoints()).path);
  FileMarks marks = load_marks(checkpoint);
  if (marks.history_bytes == 0)
    checkpoint.fail("\"files/history_bytes\" is 0: a table has its header at least");
  if (!marks.changes.empty())
    throw CheckpointError(
        paths_.checkpoints().string() +
        ": error: the run was changed on its way by a script, which the scene does not tell: " +
        marks.changes + "; run the script anew");
  require_same_specimen(marks, paths_);
  require_same_inputs(marks, scene_, output_.inputs());
  return marks;
}

// What a checkpoint says of files, which the disk then has.
FileMarks CompressionRun::marks_of_files() {
  FileMarks marks;
  for (Observer *observer : observers_)
    observer->mark(marks);
  marks.specimen_sum = specimen_sum_;
  marks.input_sums = output_.inputs().dump();
  marks.wall_seconds = costs().wall_seconds;
  marks.target_strain = scene_.loading.target_strain;
  marks.changes = changes_.empty() ? "" : changes_.dump();
  return marks;
}

void CompressionRun::require_memory(const dem::Shape &shape) {
  apps::require_memory(scene_, shape);
  if (command_.dry_run) counted_ = counted_estimate(scene_, shape);
}

// What makes a test: steps enough that something happens between them, and rows enough to see a peak.
void CompressionRun::require_length() const {
  constexpr double fewest_steps = 100, most_steps = 1e12, fewest_rows = 5;
  const double transit = test_->facts().wave_transit;
  if (test_->cell() && test_->cell_ramp() < transit)
    refuse(scene_, "Loading/Confining ramp",
           fmt::format(
               "raises the pressure in {:.3g} s, while a wave needs {:.3g} s across the specimen: that is a "
               "shock. Allowed: {:.3g} s or more.",
               test_->cell_ramp(), transit, transit));
  const double step = test_->time_step(), seconds = test_->program().expected_seconds();
  const Loading &loading = scene_.loading;
  const bool own_step = scene_.time_step.fixed_step > 0,
             by_rate = !loading.staged() && !loading.servo && !loading.hydrostatic();
  const std::string entry = own_step && seconds / step > most_steps ? "Integration/Time step"
                            : !by_rate                              ? "Loading/Test"
                            : std::isnan(loading.rate)              ? "Loading/Wave crossings"
                                                                    : "Loading/Axial rate";
  // Of a stage that waits for a stress nobody knows how long it takes: nothing is refused then.
  for (std::size_t k = 0; k < test_->program().stage_count(); ++k)
    if (!(test_->program().stage(k).expected_seconds() > 0)) return;
  if (seconds < fewest_steps * step || seconds > most_steps * step)
    refuse(scene_, entry,
           fmt::format(
               "leaves {:.3g} steps of {:.3g} s ({}) for a test of {:.3g} s. Allowed: {:.0f} ... {:.0e}.",
               seconds / step, step, test_->time_step_reason(), seconds, fewest_steps, most_steps));
  const Interval &rows = scene_.output.every;
  const double between = rows.kind == Interval::Kind::steps ? rows.value * step : rows.value;
  if (rows.kind != Interval::Kind::none && fewest_rows * between > seconds)
    refuse(
        scene_, "Output/Every",
        fmt::format("leaves {:.2g} rows of history.csv, by which results are told, for a test of {:.3g} s. "
                    "Allowed: {:.0f} rows or more.",
                    seconds / between, seconds, fewest_rows));
}

void CompressionRun::start_pressed() {
  try {
    coupling::start_statically(*test_, scene_.loading.start_strain);
  } catch (const coupling::NumericsStopped &e) {
    throw coupling::BadSetup("loading.start_strain", std::string("has no static solution: ") + e.what() +
                                                         ". Allowed: 0, from nothing.");
  }
}

} // namespace platen::apps
