// What has changed in a scene since a folder was begun with it, and with which changes a run can be led on.
#pragma once

#include <string>
#include <vector>

#include "apps/output/output_folder.h"
#include "apps/scene/scene.h"

namespace platen::apps {

// With a larger one a test that has ended goes on.
constexpr const char *target_entry = "Loading/Target strain";

// An entry of the scene that is not as it stands in the folder's scene.prm.
struct SceneChange {
  std::string entry, was, now; // "Bond/Gap", and its texts
};

// Between two scenes whose paths hold from `folder`, in the order of the sections.
std::vector<SceneChange> differences(const Scene &before, const Scene &now,
                                     const std::filesystem::path &folder);

// In the order of the sections. Throws InputError where the folder has no scene.prm.
std::vector<SceneChange> changes_of_scene(const Scene &scene, const OutputPaths &paths);

// Throws InputError, naming the first entry that differs and may not, where the folder was begun with another
// scene. `may_change`: of an entry; null: none may.
void require_same_scene(const Scene &scene, const OutputPaths &paths,
                        bool (*may_change)(const std::string &) = nullptr);

// The same for a run that goes on from a checkpoint. Returns what may differ, for it changes nothing that has
// been computed: a larger Loading/Target strain, Loading/Stop at residual, intervals of output and
// checkpoints, the title and what is expected.
std::vector<SceneChange> require_same_physics(const Scene &scene, const OutputPaths &paths);

} // namespace platen::apps
