#include "apps/calibrate/expected_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/calibrate/trials.h"
#include "apps/output/progress.h"
#include "apps/programs.h"
#include "apps/run/needs.h"
#include "apps/run/quasi_static.h"
#include "apps/scene/parameters.h"

namespace platen::apps {
namespace {

// Of the ready concrete of scenes/parts: strain between the platens at the peak over strength by Young's
// modulus, and Voigt's modulus, which waves go by, over Young's (compression; a tension test is straight).
constexpr double bent_curve = 1.3, voigt_over_young = 1.3;
constexpr double usual_packing_fraction = 0.6;

// The scenes of the tests that are runs, by their places.
std::map<std::size_t, Scene> scenes_of_tests(const Scene &scene, const CommandLine &command,
                                             const Goals &goals) {
  std::map<std::size_t, Scene> scenes;
  for (const Goal &goal : goals.all())
    for (const std::size_t place : {goal.test, goal.other}) {
      const SpecimenTest &test = goals.tests()[place];
      if (!test.loads() || scenes.count(place) > 0) continue;
      try {
        Scene led_to =
            read_scene(command.scene, entries_of(scene, command, test, choice_of(scene), scene.general.seed),
                       program(test.program));
        for (const std::string &note : led_to.notes)
          for (const std::string &entry : test.entries)
            if (note.find(": note: " + entry.substr(0, entry.find(" =")) + " =") != std::string::npos)
              throw InputError(note);
        scenes.emplace(place, std::move(led_to));
      } catch (const InputError &error) {
        scene.parameters->refuse(goal.entry,
                                 std::string("leads to a test that cannot be run:\n") + error.what());
      }
    }
  return scenes;
}

// NaN where the goal does not tell.
double strain_at_peak(const Goal &goal, double young) {
  if (goal.curve) {
    const std::vector<double> &stress = goal.curve->stress;
    const auto top = std::max_element(stress.begin(), stress.end()) - stress.begin();
    return goal.curve->strain[static_cast<std::size_t>(top)];
  }
  if (goal.kind == TargetKind::strain_at_peak) return goal.value;
  if (goal.kind == TargetKind::tension) return goal.value / young;
  return goal.kind == TargetKind::strength ? bent_curve * goal.value / young : not_given;
}

// Of compression tests without a cell and of tension tests whose strength, strain at the peak or curve is
// wanted beside Young's modulus; nothing of others. A guess: that a specimen of the wanted figures is
// strained as ready concretes are at their peak, and that its bonds are as much stiffer than it.
std::string pace_of(const Scene &scene, const Goals &goals, std::size_t place, const Scene &led_to) {
  if (goals.tests()[place].program != "compress" || led_to.loading.confined()) return "";
  double young = not_given, strain = not_given;
  for (const Goal &goal : goals.all())
    if (goal.kind == TargetKind::young_modulus && std::isnan(young)) young = goal.value;
  for (const Goal &goal : goals.all())
    if (goal.test == place) strain = std::fmin(strain, strain_at_peak(goal, young));
  const double share = scene.model.density_of == dem::DensityOf::grains ? usual_packing_fraction : 1,
               wave = std::sqrt(voigt_over_young * young /
                                (scene.model.density * scene.model.mass_scaling * share));
  // Strain times height over the rate is the time to the peak, height over the wave's speed that of a wave.
  const double height = led_to.specimen.height, rate = led_to.loading.rate,
               transits = strain * height / rate / (height / wave);
  if (std::isnan(transits)) return "";
  const bool own_rate =
      led_to.loading.test == LoadingTest::tension && given(calibrate_of(scene).tension_rate);
  std::string text =
      fmt::format("  {}: at {:.3g} m/s about {:.0f} wave crossings to the peak, {:g} at least\n",
                  goals.tests()[place].name, rate, transits, fewest_transits);
  if (transits < fewest_transits)
    text += fmt::format(
        "    too fast to be quasi-static: such trials do not count. A lower {} helps: {:.2g} m/s in this "
        "test\n",
        own_rate ? "Calibrate/Tension rate" : "Loading/Axial rate", rate * transits / fewest_transits);
  return text;
}

} // namespace

std::string expected_tests(const Scene &scene, const CommandLine &command, const Goals &goals) {
  constexpr double threads = 2; // that counted_costs supposes
  const Calibrate &c = calibrate_of(scene);
  std::string text;
  double seconds = 0; // of one core, of all tests of a packing, to their largest strains
  for (const auto &[place, led_to] : scenes_of_tests(scene, command, goals)) {
    text += pace_of(scene, goals, place, led_to);
    const double counted = threads * counted_costs(led_to).seconds;
    seconds += std::isfinite(counted) ? counted : 0;
  }
  if (seconds > 0)
    text += fmt::format("  {} trials at most: {} of one core, to the largest strains\n", c.most_trials,
                        duration_text(seconds * (c.most_trials * c.seeds + c.verification_seeds)));
  return text;
}

} // namespace platen::apps
