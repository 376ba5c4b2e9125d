#include "apps/calibrate/expected_pace.h"

#include <algorithm>
#include <cmath>
#include "apps/calibrate/trials.h"
#include "apps/programs.h"

namespace platen::apps {
namespace {

// Of the ready concrete of scenes/parts: strain between the platens at the peak over strength by Young's
// modulus, and Voigt's modulus, which waves go by, over Young's (compression; a tension test is straight).
constexpr double bent_curve = 1.3, voigt_over_young = 1.3;
constexpr double usual_packing_fraction = 0.6;

double wanted(const Goals &goals, TargetKind kind) {
  for (const std::size_t k : goals.wanted())
    if (goals.all()[k].target.kind == kind) return goals.all()[k].target.value;
  return not_given;
}

// NaN where the goal does not tell.
double strain_at_peak(const Goal &goal, double young) {
  switch (goal.target.kind) {
    case TargetKind::strain_at_peak:
      return goal.target.value;
    case TargetKind::strength:
      return bent_curve * goal.target.value / young;
    case TargetKind::tension:
      return goal.target.value / young;
    case TargetKind::curve: {
      const auto top = std::max_element(goal.curve->stress.begin(), goal.curve->stress.end());
      return goal.curve->strain[static_cast<std::size_t>(top - goal.curve->stress.begin())];
    }
    default:
      return not_given;
  }
}

} // namespace

std::vector<ExpectedPace> expected_paces(const Scene &scene, const CommandLine &command, const Goals &goals) {
  const double young = wanted(goals, TargetKind::young_modulus),
               share = scene.model.density_of == dem::DensityOf::grains ? usual_packing_fraction : 1,
               wave = std::sqrt(voigt_over_young * young /
                                (scene.model.density * scene.model.mass_scaling * share));
  std::vector<ExpectedPace> paces;
  for (std::size_t t = 0; t < goals.tests().size(); ++t) {
    const SpecimenTest &test = goals.tests()[t];
    if (test.program != "compress") continue;
    const Scene led_to =
        read_scene(command.scene, entries_of(scene, command, test, choice_of(scene), scene.general.seed),
                   program("compress"));
    if (led_to.loading.confined()) continue;
    double strain = not_given;
    for (const std::size_t k : goals.wanted())
      if (goals.all()[k].test == t) strain = std::fmin(strain, strain_at_peak(goals.all()[k], young));
    // Strain times height over the rate is the time to the peak, height over the wave's speed that of a wave.
    const double height = led_to.specimen.height, rate = led_to.loading.rate,
                 transits = strain * height / rate / (height / wave);
    if (std::isnan(transits)) continue;
    const bool tension = led_to.loading.test == LoadingTest::tension,
               own_rate = tension && given(calibrate_of(scene).tension_rate);
    paces.push_back({test.name, rate, transits, own_rate ? "Calibrate/Tension rate" : "Loading/Axial rate"});
  }
  return paces;
}

} // namespace platen::apps
