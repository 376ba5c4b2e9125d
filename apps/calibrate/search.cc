#include "apps/calibrate/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/calibrate/seeds.h"

namespace platen::apps {
namespace {

// Of Poisson's ratio; static solves have no scatter but that of the packings.
constexpr double poisson_tolerance = 1e-4;
constexpr int most_elastic = 30;
// Of the first step in the ratio of the bond's strengths.
constexpr double first_step = 1.4;
// Where no run comes to a peak the bonds are too strong for the largest strain.
constexpr double weaker = 0.5;
constexpr int most_weaker = 4;
// Logarithm of compressive over tensile strength, measured over wanted, that is told as missed.
constexpr double out_of_reach = 0.05;

bool wanted(double value) {
  return !std::isnan(value);
}

class Search {
public:
  Search(const Scene &scene, Trials &trials, RunLog &log)
      : scene_(scene), c_(scene.calibrate), trials_(trials), log_(log), seeds_(training_seeds(scene)) {
    found_.choice = choice_of(scene);
  }

  Found operator()() {
    if (wanted(c_.poisson_ratio)) find_poisson_ratio();
    if (wanted(c_.young_modulus)) find_modulus();
    if (wanted(c_.compressive_strength) || wanted(c_.tensile_strength)) find_strengths();
    const bool strengths = wanted(c_.compressive_strength) || wanted(c_.tensile_strength);
    found_.training = measure(found_.choice, seeds_, strengths);
    found_.unseen = measure(found_.choice, unseen_seeds(scene_), strengths);
    return found_;
  }

private:
  bool beam() const { return scene_.effects.bond == BondKind::cohesive_beam; }
  Measured measure(const BondChoice &choice, const std::vector<unsigned long> &seeds, bool strengths);
  double &poisson_knob(BondChoice &choice) const {
    return beam() ? choice.radius_multiplier : choice.stiffness_ratio;
  }
  double poisson_at(double knob);
  void find_poisson_ratio();
  void find_modulus();
  void find_strengths();
  Measured strengths_at(double log_ratio);
  double missing(const Measured &m) const;
  void scale_strengths(const Measured &m);
  void set_ratio(double log_ratio);
  double off(const Measured &m) const;
  double largest_ratio() const;

  struct Attempt {
    double ratio, missing; // logarithms: of shear over tensile strength; measured over wanted
    BondChoice choice;
    Measured measured;
  };
  double next_ratio(const std::vector<Attempt> &all) const;

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
      (asked[k].kind == TrialKind::tension ? m.tensile : m.compressive).add(r.strength);
    }
  }
  return m;
}

double Search::poisson_at(double knob) {
  BondChoice choice = found_.choice;
  poisson_knob(choice) = knob;
  const Measured m = measure(choice, seeds_, false);
  if (m.poisson.count() == 0) throw NumericsError("no static solve came to an end; trials.csv says why");
  log_.info("  {} {:.5g}: nu {:.5f}", beam() ? "radius multiplier" : "stiffness ratio", knob,
            m.poisson.mean());
  return m.poisson.mean();
}

// Poisson's ratio falls with either knob: regula falsi, with halves where one end stays (Illinois).
void Search::find_poisson_ratio() {
  double a = beam() ? c_.multiplier_low : c_.ratio_low, b = beam() ? c_.multiplier_high : c_.ratio_high;
  double fa = poisson_at(a) - c_.poisson_ratio, fb = poisson_at(b) - c_.poisson_ratio;
  if (fa * fb > 0) {
    const bool low = std::abs(fa) < std::abs(fb);
    poisson_knob(found_.choice) = low ? a : b;
    found_.missed.push_back(
        fmt::format("Poisson's ratio {:.4g} is out of reach: {} from {:.4g} to {:.4g} gives {:.4f} to "
                    "{:.4f}; the nearest is {:.4g}",
                    c_.poisson_ratio, beam() ? "a radius multiplier" : "a stiffness ratio", a, b,
                    fa + c_.poisson_ratio, fb + c_.poisson_ratio, low ? a : b));
    return;
  }
  double x = a;
  for (int k = 0; k < most_elastic; ++k) {
    x = (a * fb - b * fa) / (fb - fa);
    const double f = poisson_at(x) - c_.poisson_ratio;
    if (std::abs(f) <= poisson_tolerance) break;
    if (f * fb < 0)
      a = b, fa = fb;
    else
      fa *= 0.5;
    b = x, fb = f;
  }
  poisson_knob(found_.choice) = x;
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

// Up to the largest ratio of the bond's strengths; beyond it, where shear decides nothing any more, moments
// count less and less.
void Search::set_ratio(double log_ratio) {
  const double high = std::log(c_.strengths_high), beyond = std::max(0.0, log_ratio - high);
  found_.choice.shear_strength = std::exp(std::min(log_ratio, high)) * found_.choice.tensile_strength;
  const double own = scene_.bond.moment_contribution;
  if (c_.moments_low < own)
    found_.choice.moment_contribution = own + std::min(beyond, 1.0) * (c_.moments_low - own);
}
double Search::largest_ratio() const {
  return std::log(c_.strengths_high) + (c_.moments_low < scene_.bond.moment_contribution ? 1 : 0);
}

// Logarithm of compressive over tensile strength, measured over wanted.
double Search::missing(const Measured &m) const {
  return std::log(m.compressive.mean() / m.tensile.mean() * c_.tensile_strength / c_.compressive_strength);
}

// Both strengths are proportional to the bond's: what the wanted ones ask for, in the (geometric) mean.
void Search::scale_strengths(const Measured &m) {
  double sum = 0;
  int count = 0;
  if (wanted(c_.compressive_strength))
    sum += std::log(c_.compressive_strength / m.compressive.mean()), ++count;
  if (wanted(c_.tensile_strength)) sum += std::log(c_.tensile_strength / m.tensile.mean()), ++count;
  const double factor = std::exp(sum / count);
  found_.choice.tensile_strength *= factor;
  found_.choice.shear_strength *= factor;
}

Measured Search::strengths_at(double log_ratio) {
  for (int k = 0; k <= most_weaker; ++k) {
    set_ratio(log_ratio);
    ++found_.strength_trials;
    const Measured m = measure(found_.choice, seeds_, true);
    const bool all = (m.compressive.count() > 0 || !wanted(c_.compressive_strength)) &&
                     (m.tensile.count() > 0 || !wanted(c_.tensile_strength));
    log_.info(
        "  trial {}: bond strengths {:.5g} MPa in tension, {:.5g} MPa in shear, moment contribution {:.4g}: "
        "{:.4g} MPa in compression, {:.4g} MPa in tension",
        found_.strength_trials, 1e-6 * found_.choice.tensile_strength, 1e-6 * found_.choice.shear_strength,
        found_.choice.moment_contribution, 1e-6 * m.compressive.mean(), 1e-6 * m.tensile.mean());
    if (all) return m;
    found_.choice.tensile_strength *= weaker;
  }
  throw NumericsError(
      "no run came to a peak; a larger Loading/Target strain, or weaker bonds to begin with, help");
}

// Of the larger of both.
double Search::off(const Measured &m) const {
  double largest = 0;
  if (wanted(c_.compressive_strength))
    largest = std::max(largest, std::abs(m.compressive.mean() / c_.compressive_strength - 1));
  if (wanted(c_.tensile_strength))
    largest = std::max(largest, std::abs(m.tensile.mean() / c_.tensile_strength - 1));
  return largest;
}

// Secants in logarithms: with the best trial on the other side where there is one, else with the last but
// one.
double Search::next_ratio(const std::vector<Attempt> &all) const {
  const Attempt &last = all.back();
  const Attempt *other = all.size() > 1 ? &all[all.size() - 2] : nullptr;
  double best = std::numeric_limits<double>::infinity();
  for (const Attempt &a : all)
    if (a.missing * last.missing < 0 && std::abs(a.missing) < best) other = &a, best = std::abs(a.missing);
  const double step = std::log(first_step);
  double next = last.ratio + (last.missing < 0 ? step : -step);
  if (other != nullptr && other->missing != last.missing && other->ratio != last.ratio)
    next =
        std::clamp(last.ratio - last.missing * (other->ratio - last.ratio) / (other->missing - last.missing),
                   last.ratio - 2 * step, last.ratio + 2 * step);
  return std::clamp(next, std::log(c_.strengths_low), largest_ratio());
}

void Search::find_strengths() {
  const bool both = wanted(c_.compressive_strength) && wanted(c_.tensile_strength);
  double ratio = std::log(found_.choice.shear_strength / found_.choice.tensile_strength);
  if (both) ratio = std::clamp(ratio, std::log(c_.strengths_low), largest_ratio());
  std::vector<Attempt> all;
  while (true) {
    const Measured m = strengths_at(ratio);
    all.push_back({ratio, both ? missing(m) : 0.0, found_.choice, m});
    if (off(m) <= c_.tolerance || found_.strength_trials >= c_.most_trials) break;
    if (both && std::abs(all.back().missing) > c_.tolerance) {
      ratio = next_ratio(all);
      if (std::any_of(all.begin(), all.end(), [&](const Attempt &a) { return a.ratio == ratio; })) break;
    }
    scale_strengths(m);
  }
  const Attempt &best = *std::min_element(all.begin(), all.end(), [&](const Attempt &a, const Attempt &b) {
    return both ? std::abs(a.missing) < std::abs(b.missing) : off(a.measured) < off(b.measured);
  });
  found_.choice = best.choice;
  scale_strengths(best.measured); // the last touch needs no run: strengths are proportional
  if (std::abs(best.missing) <= out_of_reach) return;
  const double goal = c_.compressive_strength / c_.tensile_strength;
  found_.missed.push_back(fmt::format(
      "compressive over tensile strength {:.4g} was not reached in {} trials: the nearest is {:.4g}, at a "
      "bond shear "
      "strength of {:.4g} times the tensile one (searched from {:.4g} to {:.4g}) and a moment contribution "
      "of {:.4g} "
      "(down to {:.4g}); a larger Bond/Friction angle or Contact/Friction moves it too",
      goal, found_.strength_trials, goal * std::exp(best.missing),
      best.choice.shear_strength / best.choice.tensile_strength, c_.strengths_low, c_.strengths_high,
      best.choice.moment_contribution, std::min(c_.moments_low, scene_.bond.moment_contribution)));
}

} // namespace

Found search(const Scene &scene, Trials &trials, RunLog &log) {
  return Search(scene, trials, log)();
}

} // namespace platen::apps
