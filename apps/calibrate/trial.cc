#include "apps/calibrate/trial.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/run/problem_setup.h"
#include "apps/scene/parameters.h"
#include "coupling/static_press.h"
#include "dem/measure/gauge.h"

namespace platen::apps {
namespace {

// Readings of the stress on the way to the largest strain, as many as platen-compress takes.
constexpr double readings = 600;
// A run is over when the stress has fallen to this share of its peak; moduli are secants at that of 40 %.
constexpr double fallen = 0.8, modulus_share = 0.4;
// A confined specimen may flow on: its peak counts if it lies before this share of the largest strain.
constexpr double before_the_end = 0.8;
// Largest strain of a tension test over that of a compression test.
constexpr double tension_strain = 0.25;

Scene chosen(const Scene &scene, const BondChoice &choice) {
  Scene s = scene;
  s.model.bond_layout.modulus = choice.modulus;
  s.model.bond_layout.radius_multiplier = choice.radius_multiplier;
  s.bond.set("stiffness_ratio", choice.stiffness_ratio);
  s.bond.set("poisson_ratio", choice.poisson_ratio);
  s.bond.set("tensile_strength", choice.tensile_strength);
  s.bond.set("shear_strength", choice.shear_strength);
  s.bond.set("moment_contribution", choice.moment_contribution);
  s.bond.set("friction_angle", choice.friction_angle);
  s.model.energy_ledger = s.model.crack_log = false;
  return s;
}

double tension_rate(const Scene &scene) {
  const Calibrate &c = scene.calibrate;
  if (!std::isnan(c.tension_rate)) return c.tension_rate;
  const double ratio = c.tensile_strength / c.compressive_strength;
  return scene.loading.rate * (std::isnan(ratio) ? 0.1 : ratio);
}

struct Reading {
  double stress = 0, strain_platen = 0, axial = 0, lateral = 0; // signed by the sense of the test
  Reading minus(const Reading &o) const {
    return {stress - o.stress, strain_platen - o.strain_platen, axial - o.axial, lateral - o.lateral};
  }
};

// Linear between the readings on both sides of a share of the peak, before it.
void add_moduli(const std::vector<Reading> &all, double peak, TrialResult &result) {
  for (std::size_t k = 1; k < all.size(); ++k) {
    const Reading &a = all[k - 1], &b = all[k];
    if (b.stress < modulus_share * peak) continue;
    const double w = (modulus_share * peak - a.stress) / (b.stress - a.stress);
    const auto at = [&](double Reading::*value) { return (1 - w) * a.*value + w * b.*value; };
    result.young_modulus = modulus_share * peak / at(&Reading::axial);
    result.platen_modulus = modulus_share * peak / at(&Reading::strain_platen);
    result.poisson_ratio = at(&Reading::lateral) / at(&Reading::axial);
    return;
  }
}

void load_to_peak(coupling::PlatenTest &problem, TrialKind kind, double target, TrialResult &result) {
  const double sign = kind == TrialKind::tension ? -1 : 1;
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  const double step_closes = problem.settings().loading.rate * problem.time_step() / problem.shape().height;
  const long between = std::max(1L, std::lround(target / readings / step_closes));
  const auto read = [&]() -> Reading {
    const dem::GaugeStrain strain = gauge.strain(problem.model.particles);
    return {sign * 0.5 * (problem.stress_top() + problem.stress_bottom()), sign * problem.closure_strain(),
            -sign * strain.axial, sign * strain.lateral()};
  };
  while (!problem.axial_stage())
    problem.advance(between);
  const bool confined = problem.cell();
  const Reading start = confined ? read() : Reading{};
  std::vector<Reading> all{{}};
  double peak = 0;
  while (all.back().strain_platen < target) {
    for (long made = 0; made < between;)
      made += problem.advance(between - made);
    all.push_back(read().minus(start));
    const Reading &now = all.back();
    if (now.stress > peak) peak = now.stress, result.strain_at_peak = now.strain_platen;
    const bool broken = problem.model.broken_tension + problem.model.broken_shear > 0;
    if (broken && now.stress < fallen * peak) {
      result.strength = peak + start.stress;
      add_moduli(all, peak, result);
      return;
    }
  }
  if (confined && result.strain_at_peak < before_the_end * target) {
    result.strength = peak + start.stress;
    add_moduli(all, peak, result);
    return;
  }
  result.strain_at_peak = not_given;
  result.status = "no peak before the largest strain";
}

} // namespace

const char *word(TrialKind kind) {
  constexpr const char *words[] = {"elastic", "compression", "tension", "triaxial"};
  return words[static_cast<int>(kind)];
}

BondChoice choice_of(const Scene &scene) {
  const Bond &b = scene.bond;
  const dem::BondLayout &layout = scene.model.bond_layout;
  return {layout.modulus,
          b.number("stiffness_ratio"),
          layout.radius_multiplier,
          b.number("poisson_ratio"),
          b.number("tensile_strength"),
          b.number("shear_strength"),
          b.number("moment_contribution"),
          b.number("friction_angle")};
}

TrialResult elastic_trial(const Scene &scene, const dem::Specimen &specimen, const BondChoice &choice) {
  TrialResult result;
  try {
    coupling::PlatenTest problem(specimen, problem_settings(chosen(scene, choice)));
    const coupling::StaticPress p = coupling::press_statically(problem, scene.calibrate.strain);
    result.young_modulus = p.youngs_modulus();
    result.platen_modulus = p.platen_modulus();
    result.poisson_ratio = p.poisson_ratio();
  } catch (const coupling::NumericsStopped &e) {
    result.status = scene.parameters->with_entries(e.what());
  }
  return result;
}

TrialResult strength_trial(const Scene &scene, const dem::Specimen &specimen, const BondChoice &choice,
                           TrialKind kind) {
  Scene s = chosen(scene, choice);
  if (kind == TrialKind::tension) {
    s.loading.test = LoadingTest::tension;
    s.platens.glued = true;
    s.loading.rate = tension_rate(scene);
    s.loading.target_strain *= tension_strain;
  } else {
    s.loading.test = LoadingTest::compression;
  }
  if (kind == TrialKind::triaxial) {
    s.loading.confinement = ConfinementKind::particles;
    s.loading.cell->pressure = scene.calibrate.confining_pressure;
  }
  TrialResult result;
  try {
    coupling::PlatenTest problem(specimen, problem_settings(s));
    load_to_peak(problem, kind, s.loading.target_strain, result);
  } catch (const coupling::NumericsStopped &e) {
    result.status = scene.parameters->with_entries(e.what());
  }
  return result;
}

dem::NetworkModuli bounds_of(const Scene &scene, const dem::Specimen &specimen, const BondChoice &choice) {
  const dem::ModelSettings settings = problem_settings(chosen(scene, choice)).model;
  const dem::Particles particles(specimen, settings.density, settings.rotation);
  const dem::Bonds bonds(particles, settings.bond_layout, *settings.bond);
  return dem::network_moduli(bonds, specimen.shape.volume());
}

} // namespace platen::apps
