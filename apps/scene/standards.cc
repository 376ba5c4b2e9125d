#include "apps/scene/standards.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/scene/scene_check.h"
#include "apps/scene/texts.h"

namespace platen::apps {

const std::vector<TestStandard> &test_standards() {
  static const std::vector<TestStandard> all = [] {
    const Presses of_specimens = Presses::specimens;
    // EN 12390-13 tests specimens two to four times as high as wide.
    return std::vector<TestStandard>{{"EN 12390-13", of_specimens, true, false, true, 2, 4},
                                     {"ASTM C39"},
                                     {"ASTM C469"},
                                     {"ASTM D7012", of_specimens, false, true},
                                     {"ISRM", of_specimens, false, true},
                                     {"EN 12390-6", Presses::discs}};
  }();
  return all;
}

Words<std::string> words_of_standards() {
  Words<std::string> words{{"none", "none"}};
  for (const TestStandard &one : test_standards())
    words.emplace_back(one.word, one.word);
  return words;
}

// One refusal, of the first thing that is not the standard's. What a file of spheres brings is not known.
void SceneCheck::standard() const {
  const auto asked =
      std::find_if(test_standards().begin(), test_standards().end(),
                   [&](const TestStandard &one) { return one.word == scene_.general.standard; });
  if (asked == test_standards().end() || !loads() || program_.presses == Presses::trials) return;
  if (asked->presses != program_.presses) {
    std::vector<std::string> words{"none"};
    for (const TestStandard &one : test_standards())
      if (one.presses == program_.presses) words.push_back(one.word);
    return refuse("Scene/Standard",
                  "does not go with " + program_.name + ". Allowed: " + joined(words) + ".");
  }
  if (asked->presses == Presses::discs) return; // platen-brazilian takes no other test
  const SpecimenSection &specimen = scene_.specimen;
  const Loading &loading = scene_.loading;
  const bool stated = specimen.packing != PackingKind::file || parameters_.at("Specimen/Shape").changed();
  const bool fits =
      specimen.shape == SpecimenShape::cylinder || (asked->prisms && specimen.shape == SpecimenShape::box);
  const double slender = specimen.height / specimen.width(), round_off = 1e-9; // NaN of a file
  const bool other_height =
      slender < asked->least_slenderness - round_off || slender > asked->most_slenderness + round_off;
  const auto need = [&](bool met, const std::string &entry, const std::string &allowed) {
    if (!met) refuse("Scene/Standard", "does not go with " + set_to(entry) + ". Allowed: " + allowed + ".");
  };
  need(!stated || fits, "Specimen/Shape", asked->prisms ? "cylinder, box" : "cylinder");
  need(loading.test == LoadingTest::compression, "Loading/Test", "compression");
  need(!scene_.platens.glued, "Platens/Attachment", "contact");
  need(scene_.platens.sides == PlatenSides::two, "Platens/Sides", "two");
  need(loading.confinement == ConfinementKind::none || (asked->confined && !loading.tubed()),
       "Loading/Confinement", "none");
  need(!other_height || situation().given_by_program("Specimen/Height"), "Specimen/Height",
       fmt::format("{:g} ... {:g} times the width, which this is {:.3g} times", asked->least_slenderness,
                   asked->most_slenderness, slender));
  if (asked->cycles && !loading.staged())
    refuse("Scene/Standard",
           "needs the cycles of loading that its moduli are read off. Allowed: with "
           "Loading/Stage 1, Stage 2, ...");
}

} // namespace platen::apps
