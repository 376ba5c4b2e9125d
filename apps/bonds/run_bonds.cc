#include "apps/bonds/run_bonds.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/bonds/bond_results.h"
#include "apps/bonds/pair_section.h"
#include "apps/output/specimen_csv.h"

namespace platen::apps {
namespace {

bool is_beam(const Scene &scene) {
  return scene.bond.is<dem::CohesiveBeam>();
}

// What this test cannot do, or what its closed forms know nothing of.
void check(const Scene &scene) {
  const PairTest &test = pair_test_of(scene);
  if (!is_prescribed(scene) && !is_beam(scene) && !scene.bond.is<dem::ParallelBond>())
    refuse(scene, "Effects/Bond", "has no closed form here. Allowed: any other.");
  if (!scene.bond.has("stiffness_ratio") && test.stiffness_ratios.size() > 1)
    refuse(scene, "Pair test/Stiffness ratio list",
           std::string("is for parallel bonds: ") +
               (is_beam(scene) ? "a beam has the ratio of its section."
                               : "an elasto damage plastic bond has that of Bond/Poisson ratio."));
  if (scene.phases.by == PhasesBy::file)
    read_id_list(scene.phases.file, static_cast<std::size_t>(test.particles)); // refuses ids of no sphere
  if (scene.effects.gravity)
    refuse(scene, "Effects/Gravity", "would load the bonds before the test does. Allowed: off.");
  if (is_prescribed(scene)) return; // what else it asks for is checked with the scene
  if (scene.model.local_damping < .05)
    refuse(scene, "Integration/Damping",
           "lets the spheres oscillate for ever. Allowed: 0.05 ... 1 (0.7 is best).");
  if (!std::isnan(test.force) && !std::isnan(test.displacement))
    refuse(scene, "Pair test/Displacement",
           "contradicts Pair test/Force. Allowed: one of both drives the test.");
  if (!scene.model.rotation && turns(scene))
    refuse(scene, "Effects/Rotation", "is off, but Pair test/Path turns a sphere. Allowed: on.");
  if (!is_pyramid(scene)) return;
  if (test.path != PairPath::compression && test.path != PairPath::cyclic)
    refuse(scene, "Pair test/Path",
           "needs two particles: three stand on a plate that cannot pull. Allowed: compression, cyclic.");
  if (!scene.model.rotation && test.plate == PairPlate::rolling)
    refuse(scene, "Pair test/Plate", "= rolling needs Effects/Rotation = on.");
  if (!test.base_bond && scene.effects.contact)
    refuse(
        scene, "Pair test/Base bond",
        "= off needs Effects/Contact = none: the base spheres touch, and the closed form knows no contact.");
}

std::string description(const Scene &scene) {
  const PairTest &t = pair_test_of(scene);
  std::string text = title_of(scene);
  text += fmt::format("\n  {} spheres of radius {:g} m, {}", t.particles, scene.specimen.sphere_radius,
                      word_of(pair_paths, t.path));
  if (!std::isnan(t.force))
    text += fmt::format(" up to {:g} {}", t.force * (turns(scene) ? scene.specimen.sphere_radius : 1),
                        turns(scene) ? "N m" : "N");
  else if (!t.turns.empty())
    text += fmt::format(" by {} turns to {:g} m", t.turns.size(), t.turns.back());
  else
    text += fmt::format(" up to {:g} {}", t.displacement / (turns(scene) ? scene.specimen.sphere_radius : 1),
                        turns(scene) ? "rad" : "m");
  text += fmt::format(" in {} steps\n", t.steps);
  if (is_pyramid(scene))
    text +=
        fmt::format("  plate {}, base bond {}\n", word_of(pair_plates, t.plate), t.base_bond ? "on" : "off");
  text += fmt::format("  rotation {}; {} moduli, {} stiffness ratios\n", scene.model.rotation ? "on" : "off",
                      t.moduli.size(), t.stiffness_ratios.size());
  return text;
}

BondRun run_one(const Scene &scene, double modulus, double ratio) {
  if (is_prescribed(scene)) return CohesiveTest(scene, modulus, ratio).run();
  BondRig rig(scene, modulus, ratio);
  BondRun run;
  run.modulus = modulus;
  run.stiffness_ratio = rig.section().shear_ratio();
  run.bonds = static_cast<std::size_t>(rig.bonds_at_start());
  run.bond_area = rig.section().area();
  run.time_step = rig.time_step();
  run.time_step_reason = rig.time_step_reason();
  run.path = follow_path(rig, scene);
  run.add(rig.model(), rig.steps());
  run.fracture_work = rig.model().works.fracture;
  const PairTest &t = pair_test_of(scene);
  run.strain_ratio_by_hand = not_given;
  if (is_pyramid(scene)) {
    const PyramidResponse by_hand =
        pyramid_response({rig.section(), t.plate, t.base_bond, scene.model.rotation});
    run.stiffness_by_hand = by_hand.stiffness;
    run.strain_ratio_by_hand = by_hand.strain_ratio;
    run.strength_by_hand = not_given;
  } else {
    run.stiffness_by_hand = pair_stiffness(rig.section(), t.path);
    run.strength_by_hand = pair_strength(rig.section(), t.path);
  }
  return run;
}

} // namespace

std::vector<BondRun> run_bond_tests(const Scene &scene) {
  check(scene);
  std::vector<BondRun> runs;
  for (const double modulus : pair_test_of(scene).moduli)
    for (const double ratio : pair_test_of(scene).stiffness_ratios)
      runs.push_back(run_one(scene, modulus, ratio));
  return runs;
}

int run_bonds(const CommandLine &command, const Scene &scene) {
  check(scene);
  if (command.resume)
    throw InputError("--resume: a bond test takes seconds and keeps no checkpoint; run it anew");
  AppOutput output(command, scene);
  if (command.dry_run && is_prescribed(scene)) {
    const CohesiveTest test(scene, pair_test_of(scene).moduli.front(),
                            pair_test_of(scene).stiffness_ratios.front());
    fmt::print("{}  led without inertia: no time step\n", description(scene));
    return status_done;
  }
  if (command.dry_run) {
    const BondRig rig(scene, pair_test_of(scene).moduli.front(),
                      pair_test_of(scene).stiffness_ratios.front());
    fmt::print("{}  time step {:.4g} s ({})\n", description(scene), rig.time_step(), rig.time_step_reason());
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
