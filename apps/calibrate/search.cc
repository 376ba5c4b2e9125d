#include "apps/calibrate/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "apps/calibrate/strengths.h"

namespace platen::apps {
namespace {

// Of Poisson's ratio; static solves have no scatter but that of the packings.
constexpr double poisson_tolerance = 1e-4;
constexpr int most_elastic = 30;

class Search {
public:
  Search(const Scene &scene, Trials &trials, RunLog &log)
      : scene_(scene), c_(scene.calibrate), trials_(trials), log_(log), seeds_(training_seeds(scene)) {
    found_.choice = choice_of(scene);
  }

  Found operator()() {
    if (wanted(c_.poisson_ratio)) find_poisson_ratio();
    if (wanted(c_.young_modulus)) find_modulus();
    const bool strengths = wanted(c_.compressive_strength) || wanted(c_.tensile_strength);
    if (strengths) {
      const auto test = [&](const BondChoice &choice, int trial) { return strengths_of(choice, trial); };
      const FoundStrengths found = search_strengths(scene_, found_.choice, test);
      found_.choice = found.choice;
      found_.strength_trials = found.trials;
      found_.missed.insert(found_.missed.end(), found.missed.begin(), found.missed.end());
    }
    found_.training = measure(found_.choice, seeds_, strengths);
    found_.unseen = measure(found_.choice, unseen_seeds(scene_), strengths);
    return found_;
  }

private:
  bool beam() const { return scene_.bond.is<dem::CohesiveBeam>(); }
  Measured measure(const BondChoice &choice, const std::vector<unsigned long> &seeds, bool strengths);
  double &poisson_parameter(BondChoice &choice) const {
    return beam() ? choice.radius_multiplier : choice.stiffness_ratio;
  }
  double poisson_at(double parameter);
  void find_poisson_ratio();
  void find_modulus();
  Strengths strengths_of(const BondChoice &choice, int trial);

  const Scene &scene_;
  const Calibrate &c_;
  Trials &trials_;
  RunLog &log_;
  std::vector<unsigned long> seeds_;
  Found found_;
};

Measured Search::measure(const BondChoice &choice, const std::vector<unsigned long> &seeds, bool strengths) {
  std::vector<Trial> asked;
  for (const unsigned long seed : seeds) {
    // The longest first, so that no thread ends alone with one.
    if (strengths && wanted(c_.triaxial_strength)) asked.push_back({TrialKind::triaxial, seed, choice});
    if (strengths && wanted(c_.compressive_strength)) asked.push_back({TrialKind::compression, seed, choice});
    if (strengths && wanted(c_.tensile_strength)) asked.push_back({TrialKind::tension, seed, choice});
    asked.push_back({TrialKind::elastic, seed, choice});
  }
  const std::vector<TrialResult> results = trials_(asked);
  Measured m;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const TrialResult &r = results[k];
    if (!r.good()) {
      ++m.failed;
      log_.warning("seed {}, {}: {}", asked[k].seed, word(asked[k].kind), r.status);
    } else if (asked[k].kind == TrialKind::elastic) {
      m.young.add(r.young_modulus), m.platen.add(r.platen_modulus), m.poisson.add(r.poisson_ratio);
    } else {
      const TrialKind kind = asked[k].kind;
      (kind == TrialKind::tension ? m.tensile : (kind == TrialKind::triaxial ? m.triaxial : m.compressive))
          .add(r.strength);
    }
  }
  return m;
}

double Search::poisson_at(double parameter) {
  BondChoice choice = found_.choice;
  poisson_parameter(choice) = parameter;
  const Measured m = measure(choice, seeds_, false);
  if (m.poisson.count() == 0) throw NumericsError("no static solve came to an end; trials.csv says why");
  log_.info("  {} {:.5g}: nu {:.5f}", beam() ? "radius multiplier" : "stiffness ratio", parameter,
            m.poisson.mean());
  return m.poisson.mean();
}

// Poisson's ratio falls with either parameter.
void Search::find_poisson_ratio() {
  const double a = beam() ? c_.multiplier_low : c_.ratio_low, b = beam() ? c_.multiplier_high : c_.ratio_high;
  const double fa = poisson_at(a) - c_.poisson_ratio, fb = poisson_at(b) - c_.poisson_ratio;
  double x = std::abs(fa) < std::abs(fb) ? a : b, off = std::min(std::abs(fa), std::abs(fb));
  if (fa * fb > 0) {
    poisson_parameter(found_.choice) = x;
    found_.missed.push_back(
        fmt::format("Poisson's ratio {:.4g} is out of reach: {} from {:.4g} to {:.4g} gives {:.4f} to "
                    "{:.4f}; the nearest is {:.4g}",
                    c_.poisson_ratio, beam() ? "a radius multiplier" : "a stiffness ratio", a, b,
                    fa + c_.poisson_ratio, fb + c_.poisson_ratio, x));
    return;
  }
  // Ends by the nearest ratio so far, not by the bracket.
  const auto difference = [&](double parameter) {
    const double f = poisson_at(parameter) - c_.poisson_ratio;
    if (std::abs(f) < off) x = parameter, off = std::abs(f);
    return f;
  };
  if (off > poisson_tolerance) {
    std::uintmax_t most = most_elastic;
    boost::math::tools::toms748_solve(
        difference, a, b, fa, fb, [&](double, double) { return off <= poisson_tolerance; }, most);
  }
  poisson_parameter(found_.choice) = x;
}

// One step is exact where the platens' stiffness is a multiple of the bonds'.
void Search::find_modulus() {
  for (int k = 0; k < most_elastic; ++k) {
    const Measured m = measure(found_.choice, seeds_, false);
    if (m.young.count() == 0) throw NumericsError("no static solve came to an end; trials.csv says why");
    const double factor = c_.young_modulus / m.young.mean();
    log_.info("  bond modulus {:.5g} GPa: E {:.5g} GPa", 1e-9 * found_.choice.modulus, 1e-9 * m.young.mean());
    if (std::abs(factor - 1) < 1e-6) return;
    found_.choice.modulus *= factor;
  }
}

// One trial: all tests on all seeds.
Strengths Search::strengths_of(const BondChoice &choice, int trial) {
  const Measured m = measure(choice, seeds_, true);
  std::string text = fmt::format(
      "  trial {}: bond strengths {:.5g} MPa in tension, {:.5g} MPa in shear, moment contribution {:.4g}, "
      "friction "
      "angle {:.4g} degree:",
      trial, 1e-6 * choice.tensile_strength, 1e-6 * choice.shear_strength, choice.moment_contribution,
      choice.friction_angle / degree);
  const auto add = [&](double goal, const SeedStatistics &s, const char *where) {
    if (wanted(goal)) text += fmt::format(" {} MPa {},", text_of(s, 1e6), where);
  };
  add(c_.compressive_strength, m.compressive, "in compression");
  add(c_.tensile_strength, m.tensile, "in tension");
  add(c_.triaxial_strength, m.triaxial, "under pressure");
  text.pop_back();
  log_.info("{}", text);
  return {m.compressive.mean(), m.tensile.mean(), m.triaxial.mean()};
}

} // namespace

Found search(const Scene &scene, Trials &trials, RunLog &log) {
  return Search(scene, trials, log)();
}

} // namespace platen::apps
