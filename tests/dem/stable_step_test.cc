// The predicted limit of the time step against the one found by running.
#include "dem/stable_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::stable_step_test {
namespace {

using namespace examples;
using measured::note_figure;

// Grows without bound at this step?
bool runs_away(const Specimen &specimen, const ModelSettings &settings, double dt) {
  Model model(specimen, settings);
  Random random(1);
  double start = 0;
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    model.particles.velocity[i] = 1e-6 * random.direction(); // far inside the linear range
    if (model.particles.has_rotation())
      (*model.particles.angular_velocity)[i] = (1e-6 / radius) * random.direction();
  }
  start = kinetic_energy(model.particles);
  for (int s = 0; s < 600; ++s) {
    step(model, dt);
    // Just below the limit the scheme's own energy oscillates by 1/(1 - (dt/limit)^2), here up to 25.
    if (!(kinetic_energy(model.particles) < 300 * start)) return true;
  }
  return false;
}

// Loses nearly all of its energy by and by, as a damped model must.
bool comes_to_rest(const Specimen &specimen, const ModelSettings &settings, double dt) {
  Model model(specimen, settings);
  Random random(1);
  for (Vector3 &v : model.particles.velocity)
    v = 1e-6 * random.direction();
  const double start = kinetic_energy(model.particles);
  step(model, dt, 3000);
  return model.energy().stored() < .02 * start;
}

double real_limit(const Specimen &specimen, const ModelSettings &settings, double guess) {
  double low = .5 * guess, high = 2 * guess;
  EXPECT_FALSE(runs_away(specimen, settings, low));
  EXPECT_TRUE(runs_away(specimen, settings, high));
  while (high - low > .002 * guess)
    (runs_away(specimen, settings, .5 * (low + high)) ? high : low) = .5 * (low + high);
  return .5 * (low + high);
}

// Growth of 300 in 600 steps needs dt about 5e-5 above the limit: the running limit is sharp to the
// bisection.
void expect_close_from_below(const Specimen &specimen, const ModelSettings &settings) {
  const StableStep predicted = Model(specimen, settings).stable_step({}, 0);
  const double ratio = predicted.limit / real_limit(specimen, settings, predicted.limit);
  note_figure(10, "predicted_over_real_limit", ratio, "0.7 ... 1.002");
  EXPECT_GE(ratio, .7);
  EXPECT_LE(ratio, 1.002);
  EXPECT_FALSE(predicted.reason.empty());
}

TEST(stable_step, of_a_pair_is_that_of_its_stiffest_mode) {
  Model model(row(1, {1, 0, 0}), bonded());
  const double m = model.particles.mass[0];
  // Axial 2 k_n A/m; shear with rolling 7 k_s A/m; bending 5 k_n I/(m R^2), twist 5 k_s J/(m R^2).
  const double omega = std::sqrt(std::max(2.0, 7 * stiffness_ratio) * normal_stiffness * area / m);
  const StableStep s = model.stable_step({}, 0);
  EXPECT_GE(s.omega, omega * (1 - 1e-9));
  EXPECT_LE(s.omega, 1.01 * omega);
  EXPECT_DOUBLE_EQ(s.limit, 2 / s.omega);
  expect_close_from_below(row(1, {1, 0, 0}), bonded());
}

TEST(stable_step, of_chains_and_blocks) {
  ModelSettings still = bonded();
  still.rotation = false;
  expect_close_from_below(row(12, {1, 2, -1}), bonded());
  expect_close_from_below(packed_box(12, 12, 12), bonded());
  expect_close_from_below(packed_box(12, 12, 12), still);
}

TEST(stable_step, of_a_block_of_unequal_spheres_with_dashpots) {
  ModelSettings settings = bonded();
  settings.bond_dashpot = .2;
  Specimen specimen = packed_box(10, 10, 10);
  // Smaller spheres, bonds over the gaps: masses differ eightfold.
  for (std::size_t k = 0; k < specimen.size(); k += 3)
    specimen.radius[k] *= .5;
  settings.bond_layout.gap.value = 1.1;
  const StableStep predicted = Model(specimen, settings).stable_step({}, 0);
  EXPECT_FALSE(runs_away(specimen, settings, .95 * predicted.limit));
  EXPECT_TRUE(runs_away(specimen, settings, 1.8 * predicted.limit));
}

// Local damping holds against the motion with (1 + alpha) of the force: at large steps, where every step
// turns the velocity round, that is a spring stiffer by as much.
TEST(stable_step, knows_local_damping) {
  const Specimen specimen = packed_box(10, 10, 10);
  ModelSettings settings = bonded();
  const double undamped = Model(specimen, settings).stable_step({}, 0).limit;
  for (const double alpha : {.2, .5, .9}) {
    settings.local_damping = alpha;
    settings.damping_form = DampingForm::component;
    const double limit = Model(specimen, settings).stable_step({}, 0).limit;
    EXPECT_NEAR(limit, undamped / std::sqrt(1 + alpha), 1e-9 * undamped);
    EXPECT_TRUE(comes_to_rest(specimen, settings, .99 * limit)) << alpha;
    EXPECT_FALSE(comes_to_rest(specimen, settings, 1.02 * limit)) << alpha; // the estimate is within 1 %
    settings.damping_form = DampingForm::vector;
    EXPECT_TRUE(comes_to_rest(specimen, settings, .99 * limit)) << alpha << " along the velocity";
  }
}

TEST(stable_step, names_what_holds_the_particles) {
  ModelSettings settings = bonded();
  Model model(spheres({{0, 0, 0}, {2 * radius, 0, 0}}), settings);
  GroundSpring ground;
  ground.normal = {0, 0, 1};
  ground.normal_stiffness = 1e6;
  const auto reason = [&](const Contacts *contacts, const std::vector<GroundSpring> &springs) {
    return stable_step(model.particles, model.bonds.get(), contacts, springs, {}).reason;
  };
  EXPECT_EQ(reason(nullptr, {}).rfind("2/omega of bonds, highest mode at particle ", 0), 0u);
  EXPECT_EQ(reason(nullptr, {ground}).rfind("2/omega of bonds and platens, highest", 0), 0u);
  settings.contact = ContactSettings{};
  settings.contact->friction = settings.contact->damping = 0;
  Model touching(spheres({{0, 0, 0}, {2 * radius, 0, 0}}), settings);
  EXPECT_EQ(touching.stable_step({}, 0).reason.rfind("2/omega of bonds and contacts, highest", 0), 0u);
  EXPECT_EQ(touching.stable_step({ground}, 0).reason.rfind("2/omega of bonds, contacts and platens, ", 0),
            0u);
}

// On a spring k the lone sphere has omega^2 = k/m; the lever adds k_t R^2 / I = 2.5 k_t/m.
TEST(stable_step, knows_springs_to_the_ground) {
  ModelSettings settings = bonded();
  settings.bond.reset();
  Model model(spheres({{0, 0, 0}}), settings);
  GroundSpring ground;
  ground.normal = {0, 0, 1}, ground.arm = {0, 0, -radius};
  ground.normal_stiffness = 1e6;
  const double m = model.particles.mass[0];
  EXPECT_NEAR(model.stable_step({ground}, 0).omega, std::sqrt(1e6 / m), 1e-2 * std::sqrt(1e6 / m));
  ground.tangential_stiffness = .8e6;
  EXPECT_NEAR(model.stable_step({ground}, 0).omega, std::sqrt(3.5 * .8e6 / m),
              1e-2 * std::sqrt(3.5 * .8e6 / m));
}

TEST(stable_step, is_unlimited_where_nothing_is_stiff) {
  ModelSettings settings = bonded();
  settings.bond.reset();
  EXPECT_EQ(Model(spheres({{0, 0, 0}}), settings).stable_step({}, 0).limit,
            std::numeric_limits<double>::infinity());
}

TEST(stable_step, grows_with_the_root_of_scaled_mass) {
  ModelSettings settings = bonded();
  const double plain = Model(row(5, {1, 0, 0}), settings).stable_step({}, 0).limit;
  settings.mass_scaling = 100;
  EXPECT_NEAR(Model(row(5, {1, 0, 0}), settings).stable_step({}, 0).limit, 10 * plain, 1e-9 * plain);
}

TEST(stable_step, names_the_particle_that_sets_it) {
  Specimen specimen = row(9, {1, 0, 0});
  ModelSettings settings = bonded();
  settings.bond_layout.gap.value = 1.6; // of the smaller radius: next neighbours, not those after them
  specimen.radius[4] *= .4;             // light
  Model model(specimen, settings);
  const StableStep told = model.stable_step({}, 0);
  EXPECT_EQ(told.particle_id, 4);
  // The place costs products of its own: it is sought only where somebody asks for a limit as small as this.
  const StableStep bare = model.stable_step({}, 0, told.limit),
                   asked = model.stable_step({}, 0, 1.01 * told.limit);
  EXPECT_EQ(bare.particle_id, -1);
  EXPECT_EQ(bare.reason, "2/omega of bonds");
  EXPECT_EQ(asked.particle_id, 4);
  EXPECT_EQ(bare.limit, told.limit);
  EXPECT_EQ(asked.reason, told.reason);
}

// Who asks whether the limit is below another step is told earlier if it is not, and the same if it is.
TEST(stable_step, is_sought_as_far_as_the_question_needs) {
  for (const double dashpot : {0., .2})
    for (const double local : {0., .6}) {
      ModelSettings settings = bonded();
      settings.bond_dashpot = dashpot, settings.local_damping = local;
      Model model(packed_box(16, 16, 16), settings);
      const StableStep full = model.stable_step({}, 0), below = model.stable_step({}, 0, 1.002 * full.limit),
                       far = model.stable_step({}, 0, .5 * full.limit);
      EXPECT_EQ(below.limit, full.limit) << dashpot << " " << local;
      EXPECT_GE(far.limit, .5 * full.limit);
      EXPECT_LE(far.iterations, full.iterations);
    }
}

} // namespace
} // namespace platen::dem::stable_step_test
