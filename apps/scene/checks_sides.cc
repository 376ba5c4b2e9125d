// Platens on the sides of a box, and what does not go with them.
#include "apps/scene/scene_check.h"

namespace platen::apps {

// What of it the packed shape decides, a file's too, and how large an edge gap may be, is left to the
// library.
void SceneCheck::sides() const {
  if (!loads() || scene_.platens.sides == PlatenSides::two) return;
  const Loading &loading = scene_.loading;
  const SpecimenSection &specimen = scene_.specimen;
  const auto refuse_sides = [&](const std::string &why) { refuse("Platens/Sides", why); };
  const auto against = [&](const std::string &path, const std::string &allowed) {
    refuse_sides("does not go with " + path + " = " + parameters_.at(path).text + ". Allowed: two, or " +
                 path + " = " + allowed + ".");
  };
  if (!program_.presses_specimens()) refuse_sides("is for platen-compress. Allowed: two.");
  const bool round = specimen.shape == SpecimenShape::cylinder || specimen.shape == SpecimenShape::disc;
  if (specimen.packing != PackingKind::file && (round || specimen.round())) against("Specimen/Shape", "box");
  if (loading.test != LoadingTest::compression) against("Loading/Test", "compression");
  if (loading.confined()) against("Loading/Confinement", "none");
  if (scene_.platens.glued) against("Platens/Attachment", "contact");
  if (loading.start_strain > 0) against("Loading/Start strain", "0");
}

} // namespace platen::apps
