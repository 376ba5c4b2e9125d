// What each effect costs: one specimen without any, then with one more effect at a time, then with all, in
// turn. Prints ns per particle and step and bytes per particle, each with what it adds to the bare scene.
// Bonded: the specimen of bench_step, pressed; grains: the same spheres without bonds, overlapping a little.
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>

#include "apps/output/machine.h"
#include "base/parallel.h"
#include "workload.h"

namespace {

using namespace platen;

// A scene: the model alone, without platens, so that nothing but the effect differs.
struct Scene {
  std::string name;
  dem::ModelSettings settings;
};

dem::ModelSettings bare() {
  dem::ModelSettings s;
  s.rotation = s.energy_ledger = s.crack_log = false;
  s.local_damping = 0;
  s.bond_layout.modulus = 40e9;
  s.bond_layout.gap.value = 0.1;
  return s;
}

dem::ModelSettings bonded() {
  dem::ModelSettings s = bare();
  s.bond = dem::ParallelBond::Parameters{0.4, 1e9, 4e9, 0.7853981633974483, 0.3, false};
  return s;
}

dem::ModelSettings grains() {
  dem::ModelSettings s = bare();
  s.contact = dem::ContactSettings{};
  s.contact->tangential = dem::TangentialContact::none;
  s.contact->friction = 0.5;
  s.contact->damping = 0;
  s.contact->rolling_friction = 0.2;
  s.contact->young_modulus = 40e9;
  s.contact->poisson_ratio = 0.2;
  return s;
}

struct Effect {
  const char *name;
  std::function<void(dem::ModelSettings &)> add;
};

void rotation(dem::ModelSettings &s) {
  s.rotation = true;
}
void moments(dem::ModelSettings &s) {
  s.rotation = std::get<dem::ParallelBond::Parameters>(*s.bond).moments = true;
}
void dashpots(dem::ModelSettings &s) {
  s.bond_dashpot = 0.1;
}

std::vector<Effect> effects_of_bonds() {
  return {
      {"local damping", [](auto &s) { s.local_damping = 0.5; }},
      {"dissipative scheme", [](auto &s) { s.scheme = dem::Scheme::tchamwa_wielgosz, s.dissipation = 1.2; }},
      {"gravity",
       [](auto &s) {
         s.gravity = Vector3{0, 0, -9.80665};
       }},
      {"energy ledger", [](auto &s) { s.energy_ledger = true; }},
      {"crack log", [](auto &s) { s.crack_log = true; }},
      {"bond dashpots", dashpots},
      {"rotation", rotation},
      {"rotation, bond moments", moments},
      {"rotation, bond moments, bond dashpots", [](auto &s) { moments(s), dashpots(s); }}};
}

std::vector<Effect> effects_of_contacts() {
  using dem::TangentialContact;
  return {{"contact dashpots", [](auto &s) { s.contact->damping = 0.1; }},
          {"hertz for linear", [](auto &s) { s.contact->normal = dem::NormalContact::hertz; }},
          {"friction", [](auto &s) { s.contact->tangential = TangentialContact::coulomb; }},
          {"rotation", rotation},
          {"rotation, friction, rolling",
           [](auto &s) { rotation(s), s.contact->tangential = TangentialContact::coulomb_with_rolling; }}};
}

std::vector<Scene> scenes_of(const dem::ModelSettings &base, const std::vector<Effect> &effects) {
  std::vector<Scene> scenes{{"bare", base}};
  Scene all{"all together", base};
  for (const Effect &e : effects) {
    scenes.push_back({e.name, base});
    e.add(scenes.back().settings);
    e.add(all.settings);
  }
  scenes.push_back(all);
  return scenes;
}

// In motion, so that damping and dashpots have something to do.
void shake(dem::Particles &p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = {1e-3 * static_cast<double>(i % 7) - 3e-3, 1e-3 * static_cast<double>(i % 5) - 2e-3,
                     1e-3 * static_cast<double>(i % 3) - 1e-3};
}

void steps(dem::Model &m, double dt, int count) {
  m.begin_step(dt);
  for (int k = 1; k < count; ++k) {
    m.compute_forces(dt);
    m.end_and_begin_step(dt, dt);
  }
  m.compute_forces(dt);
  m.end_step(dt);
}

void compare(const char *title, const dem::Specimen &specimen, const std::vector<Scene> &scenes,
             const bench::Workload &o) {
  std::vector<std::unique_ptr<dem::Model>> models;
  std::vector<std::vector<double>> ns(scenes.size()), added(scenes.size());
  for (const Scene &s : scenes) {
    models.push_back(std::make_unique<dem::Model>(specimen, s.settings));
    shake(models.back()->particles);
  }
  double dt = std::numeric_limits<double>::infinity();
  for (const auto &m : models) {
    if (m->contacts) m->contacts->search(m->particles, m->bonds.get(), 0.0); // what touches counts
    dt = std::min(dt, 0.2 * m->stable_step({}, 0).limit);
  }
  for (auto &m : models)
    steps(*m, dt, o.steps / 5 + 1);
  const double per = 1e9 / (static_cast<double>(specimen.size()) * o.steps);
  for (int r = 0; r < o.repeats; ++r)
    for (std::size_t k = 0; k < models.size(); ++k) {
      ns[k].push_back(per * bench::seconds_of([&] { steps(*models[k], dt, o.steps); }));
      added[k].push_back(ns[k].back() - ns[0].back());
    }
  std::printf("\n%s: %zu particles, %zu bonds, %zu contacts\n", title, models[0]->particles.size(),
              models[0]->bonds ? models[0]->bonds->size() : 0,
              models[0]->contacts ? models[0]->contacts->touching_count() : 0);
  std::printf(
      "| effects | ns per particle-step | adds (smallest ... largest) | bytes per particle | adds |\n"
      "| --- | --- | --- | --- | --- |\n");
  const double particles = static_cast<double>(specimen.size());
  const double bare_bytes = static_cast<double>(models[0]->bytes()) / particles;
  for (std::size_t k = 0; k < models.size(); ++k) {
    const bench::Spread all = bench::spread(ns[k]), more = bench::spread(added[k]);
    const double bytes = static_cast<double>(models[k]->bytes()) / particles;
    std::printf("| %s | %.1f | %+.1f (%+.1f ... %+.1f) | %.0f | %+.0f |\n", scenes[k].name.c_str(),
                all.median, more.median, more.smallest, more.largest, bytes, bytes - bare_bytes);
  }
}

} // namespace

int main(int argc, char **argv) {
  bench::Workload o;
  o.repeats = 7;
  int threads = 1;
  bench::read_arguments(argc, argv, "Cost of each effect of a scene, alone and together.",
                        o.arguments(false, {{"--threads", &threads, "threads", 1, 256}}));

  const ThreadLimit limit(threads);
  std::printf("%s, %d threads, %s kernels\n", apps::this_machine().processor.c_str(), threads,
              dem::name(dem::best_instruction_set()));
  const dem::Specimen specimen = o.specimen();
  compare("bonded", specimen, scenes_of(bonded(), effects_of_bonds()), o);
  dem::Specimen pressed = specimen; // every grain of the packing touches its neighbours
  for (double &r : pressed.radius)
    r *= 1.001;
  compare("grains", pressed, scenes_of(grains(), effects_of_contacts()), o);
  return 0;
}
