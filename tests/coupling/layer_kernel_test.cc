// Contacts with faces in packs: the bits of the same contacts row by row, for every instruction set.
#include <gtest/gtest.h>

#include <random>

#include "sphere_scene.h"
#include "tests/instruction_sets.h"
#include "tests/same_state.h"

namespace platen::coupling::layer_kernel_test {
namespace {

// A sheet that waves, and carries along what lies on it.
struct Wave : fem::LoadedSurface {
  std::vector<Vector3> start;
  explicit Wave(const fem::SurfaceMesh &mesh, bool only_shifts) {
    set_surface(mesh);
    surface_.only_shifted = only_shifts;
    start = surface_.vertices;
  }
  double move(double time, double dt) {
    double farthest = 0;
    for (std::size_t v = 0; v < start.size(); ++v) {
      const Vector3 p = start[v], old = surface_.vertices[v];
      const double phase = 300 * p.x + 200 * p.y + 4000 * time;
      surface_.vertices[v] = surface_.only_shifted
                                 ? p + Vector3{2e-4 * std::sin(4000 * time), 0, 1e-4 * std::sin(5000 * time)}
                                 : p + 2e-4 * Vector3{std::sin(phase), std::cos(phase), std::sin(phase + 1)};
      surface_.velocities[v] = (surface_.vertices[v] - old) / dt;
      farthest = std::max(farthest, norm(surface_.vertices[v] - old));
    }
    return farthest;
  }
};

// 200 spheres dance on the sheet for 400 steps.
struct Dance {
  dem::Particles particles;
  Wave sheet;
  ContactLayer layer;
  std::size_t touched = 0, slid = 0, idle = 0;

  static dem::Specimen strewn(std::mt19937 &random) {
    std::uniform_real_distribution<double> draw(-1, 1);
    std::vector<Vector3> centres;
    for (int k = 0; k < 200; ++k)
      centres.push_back(
          {9e-3 * draw(random), 9e-3 * draw(random), sphere_radius * (1.1 + 0.15 * draw(random))});
    return spheres(centres);
  }
  Dance(const SurfaceContact &contact, bool only_shifts, bool rotation, std::mt19937 random = std::mt19937(4))
      : particles(strewn(random), 2500, rotation),
        sheet(plate(10e-3, 7).surface(), only_shifts),
        layer(particles, sheet, contact) {
    std::uniform_real_distribution<double> draw(-1, 1);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.velocity[i] = Vector3{draw(random), draw(random), draw(random)};
      if (rotation)
        (*particles.angular_velocity)[i] = 1e3 * Vector3{draw(random), draw(random), draw(random)};
    }
    constexpr double dt = 1e-7;
    for (int step = 1; step <= 400; ++step)
      move(sheet.move(step * dt, dt), dt);
  }
  void move(double of_sheet, double dt) {
    double farthest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.position[i] += dt * particles.velocity[i];
      farthest = std::max(farthest, dt * norm(particles.velocity[i]));
      particles.force[i] = {};
      if (particles.has_rotation()) (*particles.torque)[i] = {};
    }
    layer.moved(farthest + of_sheet);
    sheet.clear_loads();
    layer.add_forces(particles, sheet, dt);
    for (const ActiveContact &c : layer.contacts())
      ++touched, slid += c.sliding;
    idle += layer.history().size() - layer.closed;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.velocity[i] += (dt / particles.mass[i]) * (particles.force[i] - 3e-2 * Vector3{0, 0, 1});
      if (particles.has_rotation())
        (*particles.angular_velocity)[i] += (dt / (*particles.inertia)[i]) * (*particles.torque)[i];
    }
  }
  // Where all came to rests on every bit of every step.
  void describe(Archive &archive) {
    archive.table("particles", particles.table);
    archive.part("contacts", layer);
  }
};

// Of a mesh that gives way under its contacts, m/N, by another amount on each face.
std::vector<fem::FaceCompliance> compliances(std::size_t faces) {
  std::vector<fem::FaceCompliance> all(faces);
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) // some beyond what springs make up for
        all[f][i][k] =
            ((i == k ? 0.1 : 0.02) + 0.03 * static_cast<double>(f % 40) / (1.0 + std::hypot(i, k))) /
            plate_stiffness;
  return all;
}

TEST(layer_kernel, contacts_in_packs_are_those_row_by_row) {
  for (const bool only_shifts : {true, false})
    for (const bool rotation : {true, false})
      for (const double friction : {0.0, 0.3})
        for (const double damping : {0.0, 0.2}) {
          SurfaceContact contact = frictional(friction, 0.8 * friction);
          contact.damping = damping;
          if (damping > 0) contact.face_compliance = compliances(plate(10e-3, 7).surface().faces.size());
          contact.in_lanes = false;
          const Dance by_rows(contact, only_shifts, rotation);
          EXPECT_GT(by_rows.touched, 2000u);
          EXPECT_GT(by_rows.idle, 1000u) << "some are passed over";
          if (friction > 0) {
            EXPECT_GT(by_rows.slid, 500u);
            EXPECT_LT(by_rows.slid + 100, by_rows.touched);
          }
          contact.in_lanes = true;
          for (const dem::InstructionSet set : dem::instruction_sets_here()) {
            contact.instruction_set = set;
            const Dance packs(contact, only_shifts, rotation);
            EXPECT_EQ(packs.sheet.contact_loads(), by_rows.sheet.contact_loads());
            EXPECT_TRUE(same_state(by_rows, packs))
                << dem::name(set) << ", friction " << friction << ", damping " << damping << ", rotation "
                << rotation << ", the surface " << (only_shifts ? "shifts" : "deforms")
                << ": the bits differ";
          }
        }
}

} // namespace
} // namespace platen::coupling::layer_kernel_test
