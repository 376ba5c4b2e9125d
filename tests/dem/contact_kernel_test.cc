// Which rows of contacts are at work: the same for every instruction set, and those of the definition.
#include "dem/kernels/contact_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "base/table.h"
#include "dem/instruction_set.h"
#include "dem/laws/normal_contact.h"
#include "dem/model.h"
#include "dem/packing/specimen.h"

#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

struct Rows {
  Table particles, table;
  Column<Vector3> &position = particles.add<Vector3>("position", "m");
  Column<int> &first = table.add<int>("first", "1"), &second = table.add<int>("second", "1");
  Column<double> &rest = table.add<double>("rest_distance", "m");
  Column<int> &touching = table.add<int>("touching", "1");
};

TEST(ContactKernel, finds_rows_that_are_closer_than_at_rest_or_were_touching) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> draw(0, 1);
  Rows r;
  r.particles.resize(50);
  r.table.resize(1000);
  for (Vector3 &x : r.position)
    x = {draw(random), draw(random), draw(random)};
  r.position[17].y = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < r.table.size(); ++k) {
    r.first[k] = static_cast<int>(random() % 50), r.second[k] = static_cast<int>(random() % 50);
    r.rest[k] = k % 10 == 0 ? norm(r.position[static_cast<std::size_t>(r.second[k])] -
                                   r.position[static_cast<std::size_t>(r.first[k])])
                            : draw(random);
    r.touching[k] = random() % 20 == 0;
  }
  kernels::ContactColumns columns{};
  columns.first = r.first.data(), columns.second = r.second.data(), columns.rest_distance = r.rest.data();
  columns.touching = r.touching.data(), columns.position = r.position.data();
  const auto expected = [&](std::size_t from, std::size_t to) {
    std::vector<int> rows;
    for (std::size_t k = from; k < to; ++k) {
      const double square = norm_squared(r.position[static_cast<std::size_t>(r.second[k])] -
                                         r.position[static_cast<std::size_t>(r.first[k])]);
      if (!(square >= r.rest[k] * r.rest[k]) || r.touching[k]) rows.push_back(static_cast<int>(k));
    }
    return rows;
  };
  for (const auto &[kernels, set] : {std::pair{kernels::contact_kernels_baseline, InstructionSet::baseline},
                                     {kernels::contact_kernels_avx2, InstructionSet::avx2},
                                     {kernels::contact_kernels_avx512, InstructionSet::avx512}}) {
    if (set > best_instruction_set()) continue;
    for (const auto &[from, to] :
         {std::pair<std::size_t, std::size_t>{0, 1000}, {3, 4}, {5, 5}, {1, 992}, {7, 14}}) {
      std::vector<int> rows(to - from + 1, -7);
      const std::size_t count = kernels.rows_at_work(columns, from, to, rows.data());
      EXPECT_EQ(rows[count], -7) << "writes no more than it finds";
      rows.resize(count);
      EXPECT_EQ(rows, expected(from, to)) << name(set) << ", rows " << from << " to " << to;
    }
  }
  EXPECT_GT(expected(0, 1000).size(), 200u);
  EXPECT_LT(expected(0, 1000).size(), 800u);
}

// A cloud of spheres that fall into each other, with every choice of effects.
std::vector<char> collisions(const ModelSettings &settings) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> draw(-1, 1);
  Specimen cloud;
  while (cloud.centre.size() < 150) {
    const Vector3 x{5e-3 * draw(random), 5e-3 * draw(random), 5e-3 * draw(random)};
    bool apart = true;
    for (const Vector3 &other : cloud.centre)
      apart = apart && norm(x - other) > 1.9e-3;
    if (!apart && random() % 400 != 0) continue; // a few that overlap
    cloud.centre.push_back(x);
    cloud.radius.push_back(0.7e-3 + 0.2e-3 * draw(random));
  }
  Model model(cloud, settings);
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    model.particles.velocity[i] = -2e3 * model.particles.position[i];
    if (settings.rotation)
      (*model.particles.angular_velocity)[i] = 2e4 * Vector3{draw(random), draw(random), draw(random)};
  }
  std::vector<char> bytes;
  const auto put = [&](const auto &value) {
    const char *from = reinterpret_cast<const char *>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  };
  std::size_t most = 0;
  const double dt = 2e-8;
  for (int step = 0; step < 1500; ++step) {
    model.begin_step(dt);
    model.compute_forces(dt);
    model.end_step(dt);
    most = std::max(most, model.touching_count());
    if (step % 100 != 0) continue;
    for (std::size_t i = 0; i < model.particles.size(); ++i)
      put(model.particles.position[i]), put(model.particles.force[i]);
    const EnergyLedger energy = model.energy();
    put(energy.contacts), put(energy.friction), put(energy.damping);
  }
  EXPECT_GT(most, 30u) << "touch at once";
  return bytes;
}

TEST(ContactKernel, gives_the_same_bits_with_every_instruction_set) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz})
    for (const TangentialContact tangential :
         {TangentialContact::none, TangentialContact::coulomb, TangentialContact::coulomb_with_rolling})
      for (const double damping : {0.0, 0.1})
        for (const bool rotation : {true, false})
          for (const bool ledger : {true, false}) {
            if (!rotation && tangential == TangentialContact::coulomb_with_rolling) continue;
            ModelSettings settings;
            settings.density = 2500;
            settings.rotation = rotation;
            settings.energy_ledger = ledger;
            settings.contact.emplace();
            settings.contact->normal = normal;
            settings.contact->tangential = tangential;
            settings.contact->friction = 0.3;
            settings.contact->rolling_friction = 0.1;
            settings.contact->damping = damping;
            settings.contact->restitution = damping > 0 ? 0.7 : 1;
            settings.contact->stiffness = {Stiffness::Kind::absolute, 1e6};
            settings.instruction_set = InstructionSet::baseline;
            const std::vector<char> expected = collisions(settings);
            for (const InstructionSet set : instruction_sets_here()) {
              settings.instruction_set = set;
              EXPECT_TRUE(collisions(settings) == expected)
                  << name(set) << ": the bits differ; " << word(normal) << ", tangential "
                  << static_cast<int>(tangential) << ", damping " << damping << ", rotation " << rotation
                  << ", ledger " << ledger;
            }
          }
}

} // namespace
} // namespace platen::dem
