// Loading stages: what a scene asks beside them, and what they ask of its sides.
#include <algorithm>

#include "apps/scene/scene_check.h"
#include "coupling/boundary.h"

namespace platen::apps {
namespace {

using Ask = coupling::SideAsk::Ask;

coupling::StageScope scope_of(const Scene &scene, const Situation &situation) {
  coupling::StageScope scope;
  for (const coupling::Side side : coupling::all_sides)
    if (scene.platens.has(side)) scope.platens.push_back(side);
  scope.cell = scene.loading.confined();
  scope.rate = given(scene.loading.rate) || situation.rate_by_transits();
  scope.bonded = scene.bond.bonded();
  return scope;
}

// The first entry of a stage that the scene sets: messages about what lacks stand at its line.
std::string first_entry(const Parameters &parameters, const std::string &section) {
  for (const Entry &entry : parameters.entries())
    if (entry.path.rfind(section + "/", 0) == 0 && entry.changed()) return entry.path;
  return section + "/Until";
}

} // namespace

void SceneCheck::stages() const {
  const Loading &loading = scene_.loading;
  if (!loads() || !loading.staged()) return;
  for (std::size_t k = 0; k < loading.stages.size(); ++k)
    if (!loading.stage_sections[k].given())
      for (std::size_t later = k; later < most_stages; ++later)
        if (loading.stage_sections[later].given())
          return refuse(first_entry(parameters_, section_of_stage(later + 1)),
                        "is of a stage without the one before it: " + section_of_stage(k + 1) +
                            " is empty. Allowed: stages " + "without a gap.");
  const auto refuse_stages = [&](const std::string &path, const std::string &allowed) {
    refuse(path, "does not go with " + section_of_stage(1) + ". Allowed: " + allowed + ".");
  };
  if (!program_.presses_specimens())
    refuse(first_entry(parameters_, section_of_stage(1)), "is for platen-compress. Allowed: no stages.");
  if (loading.test != LoadingTest::compression) refuse_stages("Loading/Test", "compression");
  if (loading.servo) refuse_stages("Platens/Top/Control", "motion");
  if (loading.start_strain > 0) refuse_stages("Loading/Start strain", "0");
  if (!loading.unload_at.empty()) refuse_stages("Loading/Unload at", "none");
  if (loading.cell->path != 0) refuse_stages("Loading/Pressure path", "0");
  try {
    coupling::require_stages(loading.stages, scope_of(scene_, situation()));
  } catch (const coupling::BadSetup &e) {
    const std::string entry = parameters_.entry_of(e.member()), section = entry.substr(0, entry.rfind('/'));
    const std::string reason = parameters_.with_entries(e.reason());
    if (parameters_.at(entry).changed()) return refuse(entry, reason);
    refuse(first_entry(parameters_, section), "is of a stage whose " + entry + " " + reason);
  }
}

} // namespace platen::apps
