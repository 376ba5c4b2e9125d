#include "apps/run/changed_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "apps/scene/assignments.h"
#include "apps/scene/errors.h"
#include "apps/scene/scene_writer.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>; // of entries, by path, as they stand

// Of a scene as write_prm writes it.
Texts texts_of(const std::string &prm) {
  Texts texts;
  for (const Assignment &one : prm_assignments(prm, "scene.prm").assignments)
    if (one.kind == Assignment::Kind::value)
      texts.emplace_back(one.section + "/" + one.key, trimmed(one.text));
  return texts;
}

std::vector<SceneChange> differences(const Texts &before, const Texts &now) {
  std::map<std::string, std::string> was(before.begin(), before.end());
  std::vector<SceneChange> changes;
  for (const auto &[entry, text] : now) {
    const auto found = was.find(entry);
    const std::string earlier = found == was.end() ? "" : found->second;
    if (earlier != text) changes.push_back({entry, earlier, text});
    if (found != was.end()) was.erase(found);
  }
  for (const auto &[entry, text] : was)
    changes.push_back({entry, text, ""}); // of a program that had it
  return changes;
}

constexpr std::array<const char *, 6> free_entries{
    "Scene/Title",  "Scene/Standard",      "Loading/Stop at residual",
    "Output/Every", "Output/Fields every", "Checkpoint/Every"};
constexpr const char *expectations = "Expect/";

bool is_no_smaller_target(const SceneChange &change) {
  if (change.entry != target_entry) return false;
  try {
    return read_quantity(change.now, "1", any_number()) >= read_quantity(change.was, "1", any_number());
  } catch (const ValueError &) {
    return false;
  }
}

bool is_free(const SceneChange &change) {
  return std::count(free_entries.begin(), free_entries.end(), change.entry) > 0 ||
         change.entry.rfind(expectations, 0) == 0 ||
         change.entry == "Output/Spheres in a piece"; // of earlier versions, without effect
}

[[noreturn]] void refuse_change(const Scene &scene, const SceneChange &change, const std::string &allowed) {
  const std::string was = change.was.empty() ? "empty" : change.was;
  refuse(scene, change.entry,
         fmt::format("was {} when the run began that is to be resumed. Allowed: {}.", was, allowed));
}

} // namespace

std::vector<SceneChange> changes_of_scene(const Scene &scene, const OutputPaths &paths) {
  const std::string path = paths.scene().string();
  if (!std::filesystem::is_regular_file(path))
    throw InputError(path + ": error: is missing: the folder holds nothing to resume; leave out --resume");
  return differences(texts_of(completed_scene_text(path, paths.folder.string(), *scene.program)),
                     texts_of(scene_text(scene, paths.folder)));
}

std::vector<SceneChange> differences(const Scene &before, const Scene &now,
                                     const std::filesystem::path &folder) {
  return differences(texts_of(scene_text(before, folder)), texts_of(scene_text(now, folder)));
}

void require_same_scene(const Scene &scene, const OutputPaths &paths,
                        bool (*may_change)(const std::string &)) {
  for (const SceneChange &change : changes_of_scene(scene, paths))
    if (may_change == nullptr || !may_change(change.entry))
      refuse_change(scene, change, "the scene as it was, or a new run in another folder");
}

std::vector<SceneChange> require_same_physics(const Scene &scene, const OutputPaths &paths) {
  std::vector<SceneChange> changes = changes_of_scene(scene, paths);
  for (const SceneChange &change : changes) {
    if (is_free(change) || is_no_smaller_target(change)) continue;
    if (change.entry == target_entry)
      refuse_change(scene, change, "that or more with --resume, or a new run in another folder");
    refuse_change(
        scene, change,
        fmt::format("that, or a new run in another folder; a larger {}, {} and what stands in Expect may "
                    "change on the way",
                    target_entry, fmt::join(free_entries, ", ")));
  }
  return changes;
}

} // namespace platen::apps
