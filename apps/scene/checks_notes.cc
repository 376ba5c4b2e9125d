// Entries that were set and have no effect: as declared, then what several entries or the app decide.
#include <fmt/format.h>

#include <cmath>

#include "apps/scene/scene_check.h"
#include "apps/scene/values.h"

namespace platen::apps {

void SceneCheck::note(const std::string &path, const std::string &why) const {
  const Entry &entry = parameters_.at(path);
  if (!entry.changed() || entry.origin.file.empty()) return;
  scene_.notes.push_back(entry.origin.text() + ": note: " + path + " = " + entry.text +
                         " has no effect: " + why + ".");
}

void SceneCheck::notes_of_declarations() {
  for (const Entry &entry : parameters_.entries())
    for (const auto &idle : entry.idle) {
      const std::string why = idle(situation());
      if (why.empty()) continue;
      note(entry.path, why);
      break;
    }
}

// A few percent of the radius are a few per mille of the modulus, by the exponents of concrete.
void SceneCheck::size_note() {
  constexpr double same = 0.02;
  const SizeCorrection &size = scene_.bond.size;
  const double share = size.share(scene_.specimen);
  if (!(size.reference > 0) || size.corrects() || !(std::abs(share - 1) > same)) return;
  const Entry &radius = parameters_.at("Specimen/Sphere radius");
  scene_.notes.push_back(
      radius.origin.text() + ": note: " + radius.path + " = " + radius.text + " is " +
      fmt::format("{:.3g}", share) + " times that of the calibration, " + set_to("Bond/Calibrated radius") +
      (size.by_width() ? " over " + set_to("Bond/Calibrated width") +
                             fmt::format(" ({:.3g} spheres across the least width for {:.3g})",
                                         0.5 * scene_.specimen.width() / scene_.specimen.sphere_radius,
                                         0.5 * size.reference_width / size.reference)
                       : "") +
      ", and no exponent corrects the bonds for it: E and strengths differ.");
}

// A specimen from a file brings its own.
void SceneCheck::radius_note() {
  const char *const path = "Specimen/Sphere radius";
  const double radius = scene_.specimen.sphere_radius,
               said = read_quantity(parameters_.at(path).text, "m", any_number());
  if (scene_.specimen.packing == PackingKind::file && said != radius)
    note(path, "spheres of Specimen/File have a mean radius of " + platen::text_of(radius) + " m");
}

void SceneCheck::notes() {
  notes_of_declarations();
  size_note();
  radius_note();
  if (!scene_.loading.confined() && !parameters_.at("Loading/Confining pressure").origin.file.empty())
    note("Loading/Confinement", "Loading/Confining pressure = 0");
}

} // namespace platen::apps
