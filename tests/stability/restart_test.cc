// A restart by every bond law, with platens of each kind and a sleeve, at three moments of the specimen's
// life, and with any change of threads.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/output/checkpoint_folder.h"
#include "apps/run/run_state.h"
#include "base/parallel.h"
#include "tests/apps/scratch_folder.h"
#include "tests/coupling/set_ups.h"
#include "tests/measured.h"

namespace platen::apps::restart_test {
namespace {

using coupling::advance_to;
using coupling::PlatenTest;
using coupling::PlatenTestSettings;
using coupling::thin_cylinder;

enum Law {
  parallel_bond,
  cohesive_beam,
  elasto_damage_plastic,
  yielding_parallel_bond,
  bending_cohesive_bond,
  facet_bond
};
enum Fixed { rigid, elastic, quasi_static, sleeve };
enum Moment { before_cracks, cracking, after_peak };
constexpr std::array laws{parallel_bond,          cohesive_beam,         elasto_damage_plastic,
                          yielding_parallel_bond, bending_cohesive_bond, facet_bond};
constexpr std::array holds{rigid, elastic, quasi_static, sleeve};
constexpr std::array moments{before_cracks, cracking, after_peak};
constexpr std::array thread_counts{1, 2, 4};

void choose_yielding(PlatenTestSettings &s) {
  dem::YieldingParallelBond::Parameters p;
  p.stiffness_ratio = 0.25, p.friction_angle = 0.46, p.moment_contribution = 0.22;
  p.tensile_strength = 9e6, p.shear_strength = 36e6;
  p.compression_limits = {20e6, 45e6, 70e6}, p.compression_slopes = {3, 12, 22};
  s.model.bond = p;
}

void choose_facets(PlatenTestSettings &s) {
  dem::FacetBond::Parameters p;
  p.stiffness_ratio = 0.25, p.tensile_strength = 4e6, p.shear_strength = 22e6, p.fracture_energy = 1.2;
  p.friction_static = 0.2, p.transitional_stress = 600e6, p.friction_dynamic = 0.6;
  p.compression_limits = {20e6, 45e6, 70e6}, p.compression_slopes = {3, 12, 22};
  s.model.bond = p;
  s.model.bond_layout.modulus = 28e9;
  s.model.bond_layout.gap.value = 0.6;
}

void choose(PlatenTestSettings &s, Law law) {
  s.model.contact = dem::ContactSettings{};
  s.model.contact->friction = 0.4;
  s.model.contact->damping = 0;
  if (law == parallel_bond)
    s.model.bond = dem::ParallelBond::Parameters{0.4, 10e6, 30e6, 0.7853981633974483, 0.3};
  if (law == cohesive_beam) {
    s.model.bond_layout.modulus = 30e9;
    s.model.bond_layout.radius_rule = dem::RadiusRule::mean;
    s.model.bond_layout.radius_multiplier = 0.6;
    s.model.bond = dem::CohesiveBeam::Parameters{0.3, 30e6, 90e6, 0.7853981633974483, 0.5};
  }
  if (law == yielding_parallel_bond) choose_yielding(s);
  if (law == facet_bond) choose_facets(s);
  if (law == elasto_damage_plastic || law == bending_cohesive_bond) {
    dem::ElastoDamagePlastic::Parameters p;
    p.tensile_strength = 5e6, p.shear_strength = 16e6;
    p.friction_static = 0.9, p.friction_dynamic = 0.25;
    p.poisson_ratio = 0.2;
    p.compression_limits = {20e6, 45e6, 70e6}, p.compression_slopes = {3, 12, 22};
    p.moments = law == bending_cohesive_bond, p.moment_contribution = 0.3;
    s.model.bond = p;
    s.model.bond_layout.modulus = 28e9;
    s.model.bond_layout.by_range = true;
  }
}

void choose(PlatenTestSettings &s, Fixed fixed) {
  if (fixed == elastic || fixed == quasi_static) {
    s.platens.elastic = coupling::ElasticPlatens{};
    s.platens.spherical_seat = true;
    if (fixed == quasi_static) s.platens.elastic->motion = fem::ElasticMotion::quasi_static;
  }
  if (fixed != sleeve) return;
  coupling::press(s, 1e6, 2e-5);
  coupling::SleeveSettings &rubber = coupling::wrap(s, 1.5e-3, 0.4995);
  rubber.mass_scaling = 1, rubber.mass_damping = 1000;
  rubber.contact.friction_static = 0.3, rubber.contact.damping = 0;
}

PlatenTestSettings settings_of(Law law, Fixed fixed) {
  PlatenTestSettings s = coupling::elastic_settings(0.5);
  s.model.local_damping = 0.3;
  choose(s, law);
  s.platens.top = s.platens.bottom = {0.3, 0.2};
  s.platens.damping = 0.1;
  s.platens.thickness = 3e-3;
  s.platens.elements_across = 4;
  s.loading.rate = 1;
  s.loading.ramp = 5e-6;
  choose(s, fixed);
  return s;
}

long broken(const PlatenTest &p) {
  return p.model.broken_tension + p.model.broken_shear;
}
double stress(const PlatenTest &p) {
  return mean_stress(p) - p.confining_pressure();
}

// Steps at which each moment is there, found by a first run until the stress has fallen to 0.7 of its peak.
struct Life {
  std::array<long, 3> at{};
  long first_crack = 0, peak = 0;
  double strength = 0; // Pa
};

Life life_of(Law law, Fixed fixed) {
  constexpr long between_looks = 10, most = 20000;
  PlatenTest problem(thin_cylinder(), settings_of(law, fixed));
  Life life;
  while (problem.steps() < most) {
    advance_to(problem, problem.steps() + between_looks);
    if (life.first_crack == 0 && broken(problem) > 0) life.first_crack = problem.steps();
    if (!problem.axial_stage()) continue;
    if (stress(problem) > life.strength) life.strength = stress(problem), life.peak = problem.steps();
    if (life.first_crack > 0 && stress(problem) < 0.7 * life.strength) break;
  }
  EXPECT_LT(problem.steps(), most) << "no peak";
  // Odd numbers of steps: in the middle of a quasi-static load's mean and of a sleeve's interval.
  life.at = {life.first_crack / 2 + 1, (life.first_crack + life.peak) / 2 + 1, problem.steps() + 1};
  return life;
}

void expect_moment(const PlatenTest &p, const Life &life, Moment moment) {
  if (moment == before_cracks) {
    EXPECT_EQ(broken(p), 0);
    EXPECT_GT(stress(p) + p.confining_pressure(), 0);
    return;
  }
  EXPECT_GT(broken(p), 0);
  if (moment == cracking)
    EXPECT_LT(p.steps(), life.peak);
  else
    EXPECT_LT(stress(p), 0.75 * life.strength);
}

class Restart : public testing::ScratchFolder {
protected:
  // All that a checkpoint holds, as its file has it.
  std::string bytes_of(const PlatenTest &test) {
    return testing::content_of(
        write_checkpoint(folder_, static_cast<std::uint64_t>(test.steps()),
                         [&](StateSink &to) { save_state(to, test, Results(false), FileMarks{}); }));
  }
  // N + M steps against N steps, a checkpoint in its file, and M steps of a test made from that file: the
  // same bytes of all that a checkpoint holds. On `first` threads until the stop, then on each of `then`.
  void go_on(Law law, Fixed fixed, Moment moment, const Life &life, int first, const std::vector<int> &then) {
    const PlatenTestSettings settings = settings_of(law, fixed);
    const long stop = life.at[moment], end = stop + 300;
    std::string expected, stopped;
    {
      const ThreadLimit threads(first);
      PlatenTest whole(thin_cylinder(), settings);
      advance_to(whole, stop);
      expect_moment(whole, life, moment);
      stopped = bytes_of(whole);
      advance_to(whole, end);
      expected = bytes_of(whole);
      EXPECT_NE(expected, stopped);
    }
    for (const int next : then) {
      const ThreadLimit threads(next);
      const std::filesystem::path file = folder_ / "stopped.platen";
      testing::put(file, stopped);
      PlatenTest resumed(thin_cylinder(), settings);
      Results results(false);
      load_state(CheckpointReader(file), resumed, results);
      advance_to(resumed, end);
      const bool same = bytes_of(resumed) == expected;
      EXPECT_TRUE(same) << "law " << law << ", fixed " << fixed << ", moment " << moment
                        << ", stopped at step " << stop << ", threads " << first << " then " << next;
      ++states_, different_ += !same;
    }
  }
  // Of every law and hold: all moments and threads, or these in turn, so that every pair of them comes up.
  void go_on_everywhere(bool all) {
    for (const Law law : laws)
      for (const Fixed fixed : holds) {
        const Life life = life_of(law, fixed);
        if (!all) {
          const std::size_t turn = static_cast<std::size_t>(law + 2 * fixed);
          go_on(law, fixed, moments[static_cast<std::size_t>(law + fixed) % 3], life, thread_counts[turn % 3],
                {thread_counts[(turn + 1) % 3]});
          continue;
        }
        for (const Moment moment : moments)
          for (const int first : thread_counts)
            go_on(law, fixed, moment, life, first, {1, 2, 4});
      }
    measured::note_figure(1, "states_compared", states_, "any");
    measured::note_figure(1, "states_that_differ", different_, "none");
  }

private:
  int states_ = 0, different_ = 0;
};

TEST_F(Restart, from_a_file_goes_on_to_the_same_bits) {
  go_on_everywhere(false);
}

TEST_F(Restart, long_from_a_file_goes_on_to_the_same_bits_by_every_law_hold_moment_and_threads) {
  go_on_everywhere(true);
}

} // namespace
} // namespace platen::apps::restart_test
