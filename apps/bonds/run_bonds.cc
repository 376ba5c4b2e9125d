#include "apps/bonds/run_bonds.h"

#include <fmt/format.h>

#include "apps/bonds/bond_rig.h"
#include "apps/bonds/load_path.h"
#include "apps/bonds/prescribed_pair.h"
#include "apps/output/specimen_csv.h"
#include "apps/scene/declare.h"

namespace platen::apps {
namespace {

// What this test cannot do.
void check(const Scene &scene) {
  const PairTest &test = pair_test_of(scene);
  if (!scene.bond.has("stiffness_ratio") && test.stiffness_ratios.size() > 1)
    refuse(scene, "Pair test/Stiffness ratio list",
           std::string("is for parallel bonds and facets: ") +
               (is_prescribed(scene) ? "an elasto damage plastic bond has that of Bond/Poisson ratio."
                                     : "a beam has the ratio of its section."));
  if (scene.phases.by == PhasesBy::file)
    read_id_list(scene.phases.file, static_cast<std::size_t>(test.particles)); // refuses ids of no sphere
  if (scene.effects.gravity)
    refuse(scene, "Effects/Gravity", "would load the bonds before the test does. Allowed: off.");
  if (turns(scene) && !(scene.model.rotation && dem::bends(dem::bond_law(scene.bond.parameters().value()))))
    refuse(scene, "Pair test/Path",
           "turns spheres against each other, which their bond without moments does not resist. Allowed: "
           "tension, compression, shear, cyclic, or Effects/Rotation and Effects/Interface moments = on "
           "(Bond moments, Bond/Moment stiffness of other laws).");
  if (is_prescribed(scene)) return; // what else it asks for is checked with the scene
  if (scene.model.local_damping < .05)
    refuse(scene, "Integration/Damping",
           "lets the spheres oscillate for ever. Allowed: 0.05 ... 1 (0.7 is best).");
  if (given(test.force) && given(test.displacement))
    refuse(scene, "Pair test/Displacement",
           "contradicts Pair test/Force. Allowed: one of both drives the test.");
  if (!is_pyramid(scene)) return;
  if (test.path != PairPath::compression && test.path != PairPath::cyclic)
    refuse(scene, "Pair test/Path",
           "needs two particles: three stand on a plate that cannot pull. Allowed: compression, cyclic.");
  if (!scene.model.rotation && test.plate == PairPlate::rolling)
    refuse(scene, "Pair test/Plate", "= rolling needs Effects/Rotation = on.");
  if (!test.base_bond && scene.effects.contact)
    refuse(scene, "Pair test/Base bond",
           "= off needs Effects/Contact = none: the base spheres would press each other.");
}

std::string description(const Scene &scene) {
  const PairTest &t = pair_test_of(scene);
  std::string text = title_of(scene);
  text += fmt::format("\n  {} spheres of radius {:g} m, {}", t.particles, scene.specimen.sphere_radius,
                      word_of(pair_paths, t.path));
  const double arm = turns(scene) ? scene.specimen.sphere_radius : 1;
  if (given(t.force))
    text += fmt::format(" up to {:g} {}", t.force * arm, turns(scene) ? "N m" : "N");
  else if (!t.turns.empty())
    text += fmt::format(" by {} turns to {:g} m", t.turns.size(), t.turns.back());
  else
    text += fmt::format(" up to {:g} {}", t.displacement / arm, turns(scene) ? "rad" : "m");
  text += fmt::format(" in {} steps\n", t.steps);
  if (is_pyramid(scene))
    text +=
        fmt::format("  plate {}, base bond {}\n", word_of(pair_plates, t.plate), t.base_bond ? "on" : "off");
  text += fmt::format("  rotation {}; {} moduli, {} stiffness ratios\n", scene.model.rotation ? "on" : "off",
                      t.moduli.size(), t.stiffness_ratios.size());
  return text;
}

// For one modulus (Pa) and stiffness ratio.
Scene scene_of_run(Scene scene, double modulus, double ratio) {
  scene.model.bond_layout.modulus = modulus;
  scene.bond.set("stiffness_ratio", ratio);
  return scene;
}

// What a dry run finds out: the time step, and whether the bond can be made.
std::string first_step(const Scene &scene) {
  if (is_prescribed(scene)) {
    const PrescribedPair pair(scene);
    return "moved without inertia: no time step";
  }
  const BondRig rig(scene);
  return fmt::format("time step {:.4g} s ({})", rig.time_step(), rig.time_step_reason());
}

} // namespace

std::vector<BondRun> run_bond_tests(const Scene &scene) {
  check(scene);
  std::vector<BondRun> runs;
  for (const double modulus : pair_test_of(scene).moduli)
    for (const double ratio : pair_test_of(scene).stiffness_ratios) {
      const Scene of_run = scene_of_run(scene, modulus, ratio);
      runs.push_back(is_prescribed(scene) ? PrescribedPair(of_run).run() : follow_path(of_run));
    }
  return runs;
}

int run_bonds(const CommandLine &command, const Scene &scene) {
  check(scene);
  if (command.resume)
    throw InputError("--resume: a bond test takes seconds and keeps no checkpoint; run it anew");
  AppOutput output(command, scene);
  if (command.dry_run) {
    const PairTest &test = pair_test_of(scene);
    const Scene first = scene_of_run(scene, test.moduli.front(), test.stiffness_ratios.front());
    fmt::print("{}  {}\n", description(scene), first_step(first));
    return status_done;
  }
  output.open();
  output.log.info("{}", description(scene));
  const std::vector<BondRun> runs = run_bond_tests(scene);
  const double seconds = output.seconds();
  write_table(output.paths.folder / "bonds.csv", scene, runs);
  return output.finish(summary_of(scene, runs, output.threads(), seconds),
                       fmt::format("{}\n  {:.2f} s; results are in {}", report(scene, runs), seconds,
                                   output.paths.folder.string()));
}

} // namespace platen::apps
