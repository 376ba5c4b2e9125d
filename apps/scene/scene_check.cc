#include "apps/scene/scene_check.h"

#include "apps/scene/regular_file.h"

namespace platen::apps {

void SceneCheck::refuse(const std::string &path, const std::string &reason) const {
  if (found_.concern(path)) return;
  try {
    parameters_.refuse(path, reason);
  } catch (const EntryError &error) {
    found_.add(error);
  }
}

void SceneCheck::readable(const std::string &path, const std::string &file, const std::string &why) const {
  if (file.empty()) return refuse(path, "is not set: " + why);
  if (is_pipe_or_device(file))
    return refuse(path, "is a pipe or a device, no file (looked for " + file + ").");
  if (!open_file(file)) refuse(path, "cannot be read (looked for " + file + ").");
}

void SceneCheck::needed() const {
  for (const Entry &entry : parameters_.entries())
    for (const auto &needed : entry.needed) {
      const std::string why = entry.text.empty() ? needed({scene_, parameters_, program_}) : "";
      if (!why.empty()) refuse(entry.path, "is not set: " + why + " Allowed: " + limits(entry) + ".");
    }
}

Faults check_scene(Scene &scene, const Parameters &parameters, const Program &program) {
  Faults found;
  SceneCheck check(scene, parameters, program, found);
  check.specimen();
  check.effects();
  check.needed();
  check.bond();
  check.phases();
  check.contact();
  check.platens();
  check.asked_of_program();
  check.test();
  check.loading();
  check.standard();
  if (program.check != nullptr) program.check(check);
  check.scale();
  check.notes();
  return found;
}

} // namespace platen::apps
