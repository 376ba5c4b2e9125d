#include "apps/calibrate/abacus.h"
#include "apps/calibrate/calibrate_section.h"
#include "apps/output/csv_writer.h"
#include "apps/output/numbers.h"
#include "apps/output/seed_statistics.h"

namespace platen::apps {
namespace {

constexpr const char *columns_of_abacus =
    "seed,bond_modulus_pa,stiffness_ratio,radius_multiplier,bond_poisson,youngs_modulus_gauge_pa,"
    "youngs_modulus_platen_pa,poisson_ratio,voigt_modulus_pa,voigt_poisson,reuss_modulus_pa,reuss_poisson";

std::vector<Choice> combinations(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  std::vector<Choice> all;
  for (const double multiplier : or_own(c.radius_multipliers, scene.model.bond_layout.radius_multiplier))
    for (const double ratio : or_own(c.stiffness_ratios, scene.bond.number("stiffness_ratio")))
      for (const double poisson : or_own(c.poisson_ratios, scene.bond.number("poisson_ratio")))
        for (const double modulus : or_own(c.moduli, scene.model.bond_layout.modulus)) {
          Choice choice = choice_of(scene);
          choice[FreeParameter::radius_multiplier] = multiplier;
          choice[FreeParameter::stiffness_ratio] = ratio;
          choice[FreeParameter::poisson_ratio] = poisson;
          choice[FreeParameter::modulus] = modulus;
          all.push_back(choice);
        }
  return all;
}

} // namespace

Json make_abacus(const Scene &scene, const OutputPaths &paths, Trials &trials, RunLog &log) {
  const std::vector<Choice> choices = combinations(scene);
  const bool beams = scene.bond.is<dem::CohesiveBeam>();
  const bool linear = scene.platens.stiffness.kind != Stiffness::Kind::absolute;
  const std::vector<unsigned long> seeds = training_seeds(scene);
  std::vector<Trial> asked;
  for (const Choice &choice : choices)
    for (const unsigned long seed : seeds) {
      asked.push_back({SpecimenTest{}, seed, choice});
      if (linear) asked.back().choice[FreeParameter::modulus] = scene.model.bond_layout.modulus;
    }
  const std::vector<TrialResult> results = trials(asked);
  WholeTable table(paths.folder / "abacus.csv", cells_of(columns_of_abacus));
  Json rows = Json::array();
  log.info("  {:>10} {:>7} {:>10} {:>7} {:>12} {:>9} {:>9} {:>12} {:>9}", "bond, GPa", "ks/kn", "multiplier",
           "bond nu", "E, GPa", "+-", "nu", "Voigt, GPa", "Voigt nu");
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const Choice &c = choices[k];
    const double ratio = beams ? not_given : c[FreeParameter::stiffness_ratio],
                 bond_poisson = beams ? c[FreeParameter::poisson_ratio] : not_given;
    SeedStatistics young, poisson, voigt, voigt_poisson;
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      const TrialResult &r = results[k * seeds.size() + s]; // no numbers of one that failed
      const double scale = linear ? c[FreeParameter::modulus] / scene.model.bond_layout.modulus : 1.0;
      const dem::NetworkModuli b = network_bounds(trials.with(c, seeds[s]), trials.packing(seeds[s]));
      young.add(scale * r.number("youngs_modulus_gauge_pa")), poisson.add(r.number("poisson_ratio"));
      voigt.add(b.young_voigt), voigt_poisson.add(b.poisson_voigt);
      table.row({seeds[s], c[FreeParameter::modulus], ratio, c[FreeParameter::radius_multiplier],
                 bond_poisson, scale * r.number("youngs_modulus_gauge_pa"),
                 scale * r.number("youngs_modulus_platen_pa"), r.number("poisson_ratio"), b.young_voigt,
                 b.poisson_voigt, b.young_reuss, b.poisson_reuss});
    }
    log.info("  {:>10.5g} {:>7.4g} {:>10.4g} {:>7.4g} {:>12.5g} {:>9.2g} {:>9.4f} {:>12.5g} {:>9.4f}",
             1e-9 * c[FreeParameter::modulus], ratio, c[FreeParameter::radius_multiplier], bond_poisson,
             1e-9 * young.mean(), 1e-9 * young.deviation(), poisson.mean(), 1e-9 * voigt.mean(),
             voigt_poisson.mean());
    rows.push_back({{"bond_modulus_pa", c[FreeParameter::modulus]},
                    {"stiffness_ratio", ratio},
                    {"radius_multiplier", c[FreeParameter::radius_multiplier]},
                    {"bond_poisson_ratio", bond_poisson},
                    {"youngs_modulus_gauge_pa", young.mean()},
                    {"poisson_ratio", poisson.mean()}});
  }
  table.finish();
  return rows;
}

} // namespace platen::apps
