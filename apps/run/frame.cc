#include "apps/run/frame.h"

#include <array>
#include <cmath>
#include <utility>

#include "apps/output/file.h"
#include "apps/output/output_folder.h"
#include "apps/output/vtu.h"
#include "coupling/program_of_test.h"
#include "dem/measure/damage.h"
#include "dem/measure/fragments.h"
#include "dem/measure/stress.h"

namespace platen::apps {
namespace {

std::vector<Vector3> vectors(const Column<Vector3> &column) {
  return {column.begin(), column.end()};
}

// Of the axis that the test loads; compression positive, as in history.csv.
FrameValues values_of(const coupling::PlatenTest &problem) {
  const int axis = coupling::loaded_axis(problem);
  double stress = 0;
  for (const coupling::Side side : coupling::all_sides)
    if (coupling::axis_of(side) == axis) stress += 0.5 * problem.stress(side);
  return {{"axial_strain", problem.closure_strain(axis)}, {"axial_stress", stress}};
}

// What the files of a frame share.
struct FrameHead {
  double time; // s
  int number;
  FrameValues values;
  template <class Write>
  FrameFile file(const char *series, Write write) const {
    return {series, OutputPaths::frame_name(series, number), std::move(write)};
  }
};

// How many others each particle is bonded to or touches now; bonds that have failed and stay in their rows as
// contacts count where they press.
std::vector<int> coordination_of(const dem::Model &model) {
  const dem::Particles &p = model.particles;
  std::vector<int> count(p.size(), 0);
  const auto add = [&](int first, int second) {
    ++count[static_cast<std::size_t>(first)], ++count[static_cast<std::size_t>(second)];
  };
  if (model.bonds) {
    const dem::Bonds &b = *model.bonds;
    for (std::size_t k = 0; k < b.size(); ++k)
      if (b.normal_stiffness[k] != 0.0 && (!b.has_failed(k) || b.response(k, p).normal_force < 0))
        add(b.first[k], b.second[k]);
  }
  if (model.contacts)
    for (std::size_t k = 0; k < model.contacts->table.size(); ++k)
      if (model.contacts->touching[k] != 0) add(model.contacts->first[k], model.contacts->second[k]);
  return count;
}

FrameFile spheres_of(const coupling::PlatenTest &problem, const std::vector<int> &moves_with,
                     const FrameHead &head) {
  const dem::Model &model = problem.model;
  const dem::Particles &p = model.particles;
  const std::size_t n = p.size();
  std::vector<Vector3> displacement(n);
  for (std::size_t i = 0; i < n; ++i)
    displacement[i] = p.position[i] - p.reference_position[i];
  std::vector<double> stress;
  stress.reserve(9 * n);
  for (const auto &s :
       dem::particle_stress(p, model.bonds.get(), model.contacts.get(), problem.facts().packing_fraction))
    stress.insert(stress.end(), s.begin(), s.end());
  std::vector<double> diameter(p.radius.begin(), p.radius.end());
  for (double &d : diameter)
    d *= 2;
  std::vector<Field> fields{{"radius", std::vector<double>(p.radius.begin(), p.radius.end())},
                            {"diameter", std::move(diameter)},
                            {"displacement", displacement},
                            {"velocity", vectors(p.velocity)},
                            {"stress", std::move(stress), 9},
                            {"id", std::vector<int>(p.id.begin(), p.id.end())},
                            {"coordination", coordination_of(model)}};
  if (p.phase != nullptr) fields.push_back({"phase", std::vector<int>(p.phase->begin(), p.phase->end())});
  if (p.has_rotation()) {
    // As a rotation vector, rad.
    std::vector<Vector3> rotation(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Quaternion q = (*p.orientation)[i];
      const Vector3 v = q.w < 0 ? -vector_part(q) : vector_part(q);
      const double sine = norm(v);
      if (sine > 0) rotation[i] = (2 * std::atan2(sine, std::abs(q.w)) / sine) * v;
    }
    fields.push_back({"rotation", rotation});
  }
  if (model.bonds) {
    const dem::BondCounts counts = dem::bond_counts(p, *model.bonds);
    std::vector<double> damage(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      if (const int all = counts.intact[i] + counts.broken[i]; all > 0)
        damage[i] = static_cast<double>(counts.broken[i]) / all;
    fields.push_back({"intact_bonds", counts.intact});
    fields.push_back({"broken_bonds", counts.broken});
    fields.push_back({"damage", std::move(damage)});
    fields.push_back({"fragment", dem::find_fragments(p, model.bonds.get()).of_particle});
  }
  if (!moves_with.empty()) fields.push_back({"moves_with", moves_with});
  return head.file("specimen",
                   [head, points = vectors(p.position), fields = std::move(fields)](const auto &path) {
                     write_points(path, head.time, points, fields, head.values);
                   });
}

FrameFile bonds_of(const coupling::PlatenTest &problem, const dem::LargestOpenings &largest,
                   const FrameHead &head) {
  const dem::Particles &p = problem.model.particles;
  const dem::Bonds &b = *problem.model.bonds;
  const std::size_t n = b.initial_count();
  std::vector<std::array<int, 2>> lines(n);
  std::vector<int> state(b.state.begin(), b.state.end());
  std::vector<int> first(n), second(n);
  std::vector<Vector3> force(n);
  std::vector<double> damage(n), normal(n, 0.0), shear(n, 0.0),
      when(b.break_time.begin(), b.break_time.end());
  for (std::size_t k = 0; k < n; ++k) {
    lines[k] = {b.record_first[k], b.record_second[k]};
    first[k] = p.id[static_cast<std::size_t>(lines[k][0])];
    second[k] = p.id[static_cast<std::size_t>(lines[k][1])];
    damage[k] = state[k] >= static_cast<int>(dem::BondState::broken_in_tension) ? 1.0 : 0.0;
  }
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (b.normal_stiffness[k] == 0.0) continue;
    const auto response = b.response(k, p);
    const std::size_t record = static_cast<std::size_t>(b.record[k]);
    if (!b.has_failed(k) && b.damage(k) > 0) {
      damage[record] = b.damage(k);
      state[record] = static_cast<int>(dem::BondState::damaged);
    }
    normal[record] = response.normal_force;
    shear[record] = response.shear_force;
    force[record] = {response.force.x, response.force.y, response.force.z};
  }
  std::vector<Field> fields{{"state", std::move(state)},
                            {"damage", std::move(damage)},
                            {"normal_force", std::move(normal)},
                            {"shear_force", std::move(shear)},
                            {"force", force},
                            {"break_time", std::move(when)},
                            {"particle_a", std::move(first)},
                            {"particle_b", std::move(second)}};
  if (problem.model.settings().crack_log) {
    std::vector<double> opening(n, 0.0), slip(n, 0.0), widest(n, 0.0);
    for (const dem::Opening &o : dem::openings(p, b))
      opening[o.record] = o.opening, slip[o.record] = o.slip, widest[o.record] = largest.opening(o);
    fields.push_back({"opening", std::move(opening)});
    fields.push_back({"slip", std::move(slip)});
    fields.push_back({"largest_opening", std::move(widest)});
  }
  return head.file("bonds", [head, points = vectors(p.position), lines = std::move(lines),
                             fields = std::move(fields)](const auto &path) {
    write_lines(path, head.time, points, lines, {}, fields, head.values);
  });
}

void add_boundaries(std::vector<FrameFile> &files, const coupling::PlatenTest &problem,
                    const FrameHead &head) {
  for (const char *series : {"platens", "sleeve"}) {
    std::vector<const coupling::Pictured *> parts;
    for (const auto &boundary : problem.boundaries())
      if (const coupling::Pictured *part = boundary->pictured(); part != nullptr && part->series() == series)
        parts.push_back(part);
    int index = static_cast<int>(parts.size()) * head.number;
    for (const coupling::Pictured *part : parts) {
      files.push_back({series, OutputPaths::frame_name(series, index++),
                       [picture = part->picture(), time = head.time](const std::filesystem::path &path) {
                         write_body(path, time, picture);
                       }});
    }
  }
}

FrameFile contacts_of(const coupling::PlatenTest &problem, const FrameHead &head) {
  std::vector<Vector3> points, normals, shears, forces;
  std::vector<double> normal_force, shear_force, slip;
  std::vector<int> sliding, particle;
  for (const auto &boundary : problem.boundaries()) {
    if (boundary->pictured() == nullptr) continue;
    for (const coupling::ActiveContact &c : boundary->pictured()->contacts()) {
      points.push_back(c.point);
      normals.push_back(c.normal);
      shears.push_back(c.shear);
      forces.push_back(c.normal_force * c.normal + c.shear);
      normal_force.push_back(c.normal_force);
      shear_force.push_back(norm(c.shear));
      slip.push_back(c.slip);
      sliding.push_back(c.sliding ? 1 : 0);
      particle.push_back(problem.model.particles.id[static_cast<std::size_t>(c.particle)]);
    }
  }
  std::vector<Field> fields{{"normal", normals},
                            {"shear", shears},
                            {"force", forces},
                            {"normal_force", std::move(normal_force)},
                            {"shear_force", std::move(shear_force)},
                            {"slip", std::move(slip)},
                            {"sliding", std::move(sliding)},
                            {"particle", std::move(particle)}};
  return head.file("contacts",
                   [head, points = std::move(points), fields = std::move(fields)](const auto &path) {
                     write_points(path, head.time, points, fields, head.values);
                   });
}

} // namespace

Frame frame_of(const coupling::PlatenTest &problem, const std::vector<int> &moves_with,
               const dem::LargestOpenings &largest, int number) {
  const FrameHead head{problem.time(), number, values_of(problem)};
  Frame frame{head.time, {spheres_of(problem, moves_with, head)}};
  if (problem.model.bonds) frame.files.push_back(bonds_of(problem, largest, head));
  add_boundaries(frame.files, problem, head);
  frame.files.push_back(contacts_of(problem, head));
  return frame;
}

} // namespace platen::apps
