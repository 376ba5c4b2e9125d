#include "apps/study/target_study.h"

#include <algorithm>
#include <cmath>

#include "apps/study/runs.h"
#include "apps/study/study_section.h"
#include "apps/study/target_prior.h"

namespace platen::apps {
namespace {

// No plan has more; 1 % of a figure that scatters by 10 % needs 270.
constexpr std::size_t most_packings = 1000;

} // namespace

TargetStudy::TargetStudy(const TargetSetup &setup)
    : setup_(setup), cases_(target_cases(setup.scene)), figures_(setup.scene) {
  state_.runs.transits = target_transits(setup.scene);
  state_.made.assign(cases_.speeds, 0);
  state_.errors = expected_errors(study_of(setup.scene).target.figure, figures_.spheres());
}

double TargetStudy::step_error() const {
  const StudyTarget &target = study_of(setup_.scene).target;
  const auto measured = figures_.of_half_step();
  const bool tells = measured && measured->is_certain(target.confidence);
  return tells ? std::max(target.step_allowance, std::abs(measured->mean)) : target.step_allowance;
}

Aim TargetStudy::aim() const {
  const StudyTarget &target = study_of(setup_.scene).target;
  return {target.accuracy, target.confidence, std::pow(step_error(), 2), most_packings,
          static_cast<std::size_t>(target.pilot_seeds)};
}

std::size_t TargetStudy::side_runs() const {
  const StudyTarget &target = study_of(setup_.scene).target;
  return cases_.scenes * static_cast<std::size_t>(target.step_seeds + target.coarser_seeds);
}

std::size_t TargetStudy::most_per_scene() const {
  const auto most = static_cast<std::size_t>(study_of(setup_.scene).target.most_runs);
  return (most - std::min(most, side_runs())) / cases_.scenes;
}

std::vector<unsigned long> TargetStudy::seeds() const {
  std::vector<unsigned long> all;
  const std::size_t packings = *std::max_element(state_.made.begin(), state_.made.end());
  for (std::size_t s = 0; s < packings; ++s)
    all.push_back(setup_.scene.general.seed + s);
  return all;
}

void TargetStudy::add_to_batch(std::size_t of_case, std::size_t packing) {
  TestRun run = run_of(setup_.plan, of_case, setup_.scene.general.seed + packing, setup_.scene_path,
                       setup_.overrides, setup_.paths, 1, setup_.paths.packings());
  run.specimen_of = batch_.size();
  batch_.push_back(std::move(run));
  packings_.push_back(packing);
}

// Fast runs first: what slow ones need is packed then.
void TargetStudy::fill_batch(const Counts &next) {
  batch_.clear(), packings_.clear();
  const StudyTarget &target = study_of(setup_.scene).target;
  const bool first = *std::max_element(state_.made.begin(), state_.made.end()) == 0;
  for (std::size_t k = 0; k < cases_.speeds; ++k)
    for (std::size_t s = state_.made[k]; s < next[k]; ++s)
      for (std::size_t scene = 0; scene < cases_.scenes; ++scene)
        add_to_batch(cases_.at(scene, k), s);
  for (int s = 0; first && s < target.step_seeds; ++s)
    for (std::size_t scene = 0; scene < cases_.scenes; ++scene)
      add_to_batch(cases_.of_half_step(scene), static_cast<std::size_t>(s));
  for (int s = 0; first && s < target.coarser_seeds; ++s)
    for (std::size_t scene = 0; scene < cases_.scenes; ++scene)
      add_to_batch(cases_.of_coarser(scene), static_cast<std::size_t>(s));
  state_.made = next;
}

void TargetStudy::add(std::size_t k, const RunOutcome &outcome) {
  figures_.add(batch_[k], packings_[k], outcome);
}

bool TargetStudy::work(const Carry &carry, const Told &told) {
  Counts next = within(pilot_of(state_, figures_.costs(), aim()), state_.made, most_per_scene());
  do {
    const Counts before = state_.made;
    fill_batch(next);
    if (!carry(batch_)) {
      state_.made = before;
      return false;
    }
    state_.runs = figures_.runs();
    state_.errors.prior = expected_spread(study_of(setup_.scene).target.figure, figures_.spheres());
    decision_ = decide(state_, figures_.costs(), aim(), most_per_scene(), figures_.curvature_of_scenes());
    next = decision_.next;
    if (decision_.estimate)
      looks_.push_back({figures_.made(), seeds().size(), figures_.work(), figures_.seconds(),
                        *decision_.estimate, decision_.half});
    told();
  } while (decision_.verdict == Verdict::more);
  return true;
}

} // namespace platen::apps
