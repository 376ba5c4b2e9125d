#include "fem/hyperelastic_solid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/require.h"

namespace platen::fem {

HyperelasticSolid::HyperelasticSolid(const Grid &grid, const SolidMaterial &material,
                                     const std::vector<int> &contact_tags)
    : material_(material), mesh_(read_mesh(grid)) {
  require(material.density > 0 && std::isfinite(material.density), "solid: density must be positive");
  material_.law = NeoHookean::from_moduli(material.law.shear_modulus, material.law.bulk_modulus);
  for (const int tag : contact_tags)
    require(!mesh_.nodes_of(tag).empty(), "solid: no face has the contact tag " + std::to_string(tag));
  NodeSurface part = extract_surface(grid, contact_tags);
  set_surface(std::move(part.surface));
  surface_node_ = std::move(part.node);
  const std::size_t nodes = mesh_.nodes.size();
  vertex_of_.assign(nodes, -1);
  for (std::size_t v = 0; v < surface_node_.size(); ++v)
    vertex_of_[index(surface_node_[v])] = static_cast<int>(v);
  first_face_.assign(mesh_.cells.size() + 1, 0);
  for (const BoundaryFace &face : mesh_.faces)
    ++first_face_[index(face.cell) + 1];
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    first_face_[c + 1] += first_face_[c];
  for (const double volume : mesh_.node_volume) {
    mass_.push_back(material_.density * volume);
    volume_ += volume;
  }
  for (std::vector<Vector3> *column : {&displacement_, &velocity_, &next_, &internal_, &pressed_})
    column->assign(nodes, Vector3{});
  prescribed_.assign(nodes, 0);
  face_pressure_.assign(mesh_.faces.size(), 0.0);
  acting_ = face_pressure_;
  cell_force_.resize(mesh_.cells.size());
  if (material.hardening) {
    material.hardening->require_valid();
    plastic_ = J2Plasticity{material_.law.shear_modulus, *material.hardening};
    before_.resize(mesh_.cells.size());
    after_ = before_;
  }
  if (material.fibres) {
    material.fibres->require_valid();
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      fibre_cells_.push_back(material.fibres->layout(cell_middle(static_cast<int>(c), displacement_)));
    fibre_strain_.assign(fibre_cells_.size(), 0.0);
  }
  lay_out_stiffness();
}

double HyperelasticSolid::largest_move(double dt) const {
  double squared = 0;
  for (const Vector3 &v : velocity_)
    squared = std::max(squared, dot(v, v));
  return std::abs(dt) * std::sqrt(squared);
}

void HyperelasticSolid::place_surface() {
  for (std::size_t v = 0; v < surface_node_.size(); ++v) {
    const std::size_t n = index(surface_node_[v]);
    surface_.vertices[v] = mesh_.nodes[n] + displacement_[n];
    surface_.velocities[v] = velocity_[n];
  }
}

void HyperelasticSolid::place_surface_ahead(double dt) {
  for (std::size_t v = 0; v < surface_node_.size(); ++v) {
    const std::size_t n = index(surface_node_[v]);
    surface_.vertices[v] = mesh_.nodes[n] + (displacement_[n] + dt * velocity_[n]);
  }
}

int HyperelasticSolid::prescribe(const std::vector<int> &nodes, const std::array<bool, 3> &components) {
  unsigned char bits = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (components[k]) bits = static_cast<unsigned char>(bits | (1u << k));
  require(!nodes.empty() && bits != 0, "solid: a prescribed motion needs nodes and components");
  for (const int n : nodes) {
    require(n >= 0 && index(n) < prescribed_.size(),
            "solid: there is no node " + std::to_string(n) + " to prescribe");
    require((prescribed_[index(n)] & bits) == 0,
            "solid: node " + std::to_string(n) + " is prescribed already");
  }
  for (const int n : nodes)
    prescribed_[index(n)] = static_cast<unsigned char>(prescribed_[index(n)] | bits);
  prescribed_motions_.push_back({nodes, components});
  return static_cast<int>(prescribed_motions_.size()) - 1;
}

const HyperelasticSolid::PrescribedMotion &HyperelasticSolid::prescribed_motion(int motion) const {
  require(motion >= 0 && index(motion) < prescribed_motions_.size(),
          "solid: there is no prescribed motion " + std::to_string(motion));
  return prescribed_motions_[index(motion)];
}

void HyperelasticSolid::set_prescribed_velocity(int motion, const Vector3 &velocity, const Vector3 &spin,
                                                const Vector3 &about) {
  prescribed_motion(motion);
  PrescribedMotion &own = prescribed_motions_[index(motion)];
  own.velocity = velocity, own.spin = spin, own.about = about;
}

void HyperelasticSolid::prescribe_each(int motion) {
  prescribed_motion(motion);
  prescribed_motions_[index(motion)].each = true;
}

void HyperelasticSolid::set_node_velocities(int motion, const std::vector<Vector3> &velocities) {
  const PrescribedMotion &own = prescribed_motion(motion);
  require(own.each && velocities.size() == own.nodes.size(),
          "solid: one velocity for each node of a motion that is prescribed by nodes, please");
  for (std::size_t k = 0; k < velocities.size(); ++k)
    give_velocity(own, own.nodes[k], velocities[k]);
}

// The machine also does the work of the kinetic energy that a new prescribed velocity adds.
void HyperelasticSolid::give_velocity(const PrescribedMotion &motion, int node, const Vector3 &given) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!motion.components[k]) continue;
    double &v = velocity_[index(node)][k];
    prescribed_work_ += 0.5 * mass_[index(node)] * (given[k] * given[k] - v * v);
    v = given[k];
  }
}

Vector3 HyperelasticSolid::prescribed_force(int motion) const {
  const PrescribedMotion &own = prescribed_motion(motion);
  Vector3 sum{};
  for (const int n : own.nodes) {
    const Vector3 free = out_of_balance(index(n));
    for (std::size_t k = 0; k < 3; ++k)
      if (own.components[k]) sum[k] -= free[k];
  }
  return sum;
}

void HyperelasticSolid::set_pressure(int tag, double pressure) {
  require(std::isfinite(pressure), "solid: pressure must be finite");
  bool found = false;
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
    if (mesh_.faces[f].tag == tag) face_pressure_[f] = pressure, found = true;
  require(found, "solid: no face has the tag " + std::to_string(tag) + " to press on");
}

double HyperelasticSolid::pressure(int tag) const {
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
    if (mesh_.faces[f].tag == tag) return face_pressure_[f];
  require(false, "solid: no face has the tag " + std::to_string(tag));
  return 0;
}

void HyperelasticSolid::set_damping(double rate) {
  require(rate >= 0 && std::isfinite(rate), "solid: damping must not be negative");
  damping_ = rate;
}

void HyperelasticSolid::half_kick(double dt) {
  const double h = 0.5 * dt, drag = 0.5 * h * damping_; // uses the velocity in the middle of the kick
  struct Works {
    double prescribed = 0, damping = 0;
    void operator+=(const Works &other) { prescribed += other.prescribed, damping += other.damping; }
  };
  for (const PrescribedMotion &own : prescribed_motions_)
    if (!own.each)
      for (const int n : own.nodes)
        give_velocity(own, n, own.velocity + cross(own.spin, node_place(n) - own.about));
  const auto kick = [&](std::size_t first, std::size_t last) {
    Works sum;
    for (std::size_t n = first; n < last; ++n) {
      const Vector3 force = out_of_balance(n);
      for (std::size_t k = 0; k < 3; ++k) {
        double &v = velocity_[n][k];
        if (is_prescribed(n, k)) {
          sum.prescribed -= h * force[k] * v;
          continue;
        }
        const double before = v;
        v = ((1 - drag) * before + h / mass_[n] * force[k]) / (1 + drag);
        sum.damping += 0.5 * drag * mass_[n] * (before + v) * (before + v);
      }
    }
    return sum;
  };
  const Works works = ordered_sum<Works>(velocity_.size(), kick);
  prescribed_work_ += works.prescribed;
  damping_work_ += works.damping;
  for (std::size_t v = 0; v < surface_node_.size(); ++v)
    surface_.velocities[v] = velocity_[index(surface_node_[v])];
}

bool HyperelasticSolid::can_drift(double dt) const {
  std::vector<Vector3> there(displacement_);
  for (std::size_t n = 0; n < there.size(); ++n)
    there[n] = there[n] + dt * velocity_[n];
  return first_inverted(there).cell < 0;
}

void HyperelasticSolid::drift(double dt, bool looked) {
  for_each(next_.size(), [&](std::size_t n) { next_[n] = displacement_[n] + dt * velocity_[n]; });
  if (!looked) check(next_);
  pressure_work_ += acting_ == face_pressure_
                        ? pressure_work_to(next_, face_pressure_)
                        : 0.5 * (pressure_work_to(next_, acting_) + pressure_work_to(next_, face_pressure_));
  before_ = after_;
  if (material_.fibres) tear(next_);
  std::swap(displacement_, next_);
  place_surface();
}

void HyperelasticSolid::yield_here() {
  before_ = after_;
  if (material_.fibres) tear(displacement_);
}

// At the place of the last forces, which act for half of the way from there to `next`: what tears does their
// work, and gives the energy that it would have stored by then.
void HyperelasticSolid::tear(const std::vector<Vector3> &next) {
  for (std::size_t c = 0; c < fibre_cells_.size(); ++c) {
    if (fibre_cells_[c].share == 0 || !(fibre_strain_[c] >= material_.fibres->rupture_strain)) continue;
    const Corners own = mesh_.gather(c, displacement_), then = mesh_.gather(c, next);
    CellForce rest = cell_force(material_.law, mesh_.cells[c], own);
    fibre_cells_[c].share = 0;
    add_fibres(*material_.fibres, fibre_cells_[c], mesh_.cells[c], own, rest);
    torn_energy_ += cell_force_[c].energy - rest.energy;
    for (std::size_t a = 0; a < 8; ++a)
      torn_energy_ += 0.5 * dot(cell_force_[c].force[a] - rest.force[a], then[a] - own[a]);
  }
}

// Each cell's forces are stored separately; each node then adds the forces of its cells, in order.
void HyperelasticSolid::update_forces() {
  for_each(
      mesh_.cells.size(),
      [&](std::size_t c) {
        const Corners own = mesh_.gather(c, displacement_);
        cell_force_[c] =
            plastic_ ? cell_force(material_.law, *plastic_, mesh_.cells[c], own, before_[c], after_[c])
                     : cell_force(material_.law, mesh_.cells[c], own);
        if (material_.fibres)
          fibre_strain_[c] =
              add_fibres(*material_.fibres, fibre_cells_[c], mesh_.cells[c], own, cell_force_[c]);
      },
      cell_grain);
  for_each(internal_.size(), [&](std::size_t n) {
    Vector3 sum{};
    for (std::size_t k = mesh_.first_corner[n]; k < mesh_.first_corner[n + 1]; ++k)
      sum = sum + cell_force_[mesh_.corner[k] / 8].force[mesh_.corner[k] % 8];
    internal_[n] = sum;
  });
  add_pressure_forces();
  acting_ = face_pressure_;
}

double HyperelasticSolid::kinetic_energy() const {
  double energy = 0;
  for (std::size_t n = 0; n < velocity_.size(); ++n)
    energy += 0.5 * mass_[n] * dot(velocity_[n], velocity_[n]);
  return energy;
}

double HyperelasticSolid::internal_energy() const {
  double energy = 0;
  for (const CellForce &cell : cell_force_)
    energy += cell.energy;
  return energy;
}

double HyperelasticSolid::plastic_work() const {
  double work = 0;
  for (std::size_t c = 0; c < after_.size(); ++c)
    work += fem::plastic_work(*plastic_, mesh_.cells[c], after_[c]);
  return work;
}

std::vector<double> HyperelasticSolid::plastic_strains() const {
  std::vector<double> strains;
  for (const PlasticPoints &points : after_) {
    double sum = 0;
    for (const double strain : points.plastic_strain)
      sum += strain;
    strains.push_back(0.125 * sum);
  }
  return strains;
}

std::vector<double> HyperelasticSolid::fibre_shares() const {
  std::vector<double> shares;
  for (const FibreCell &cell : fibre_cells_)
    shares.push_back(cell.share);
  return shares;
}

void HyperelasticSolid::set_displacement(const std::vector<Vector3> &displacement) {
  require(displacement.size() == displacement_.size(), "solid: one displacement per node is needed");
  check(displacement);
  displacement_ = displacement;
  place_surface();
  update_forces();
}

void HyperelasticSolid::describe(Archive &archive) {
  archive.version(1);
  archive("pressure_work", pressure_work_, "J");
  archive("prescribed_work", prescribed_work_, "J");
  archive("damping_work", damping_work_, "J");
  for (std::size_t k = 0; k < prescribed_motions_.size(); ++k) {
    const std::string motion = "prescribed_" + std::to_string(k) + "_";
    archive(motion + "velocity", prescribed_motions_[k].velocity, "m/s");
    archive(motion + "angular_velocity", prescribed_motions_[k].spin, "rad/s");
    archive(motion + "about", prescribed_motions_[k].about, "m");
  }
  archive.same_rows("face_pressure", face_pressure_, "Pa");
  archive.same_rows("acting_pressure", acting_, "Pa");
  archive.same_rows("node_displacement", displacement_, "m");
  archive.same_rows("node_velocity", velocity_, "m/s");
  describe_loads(archive);
  if (plastic_) describe_yielding(archive);
  if (material_.fibres) describe_fibres(archive);
  if (archive.reads()) follow_state();
}

// From the memory before the last forces these are computed again to the bit.
void HyperelasticSolid::describe_yielding(Archive &archive) {
  for (std::size_t k = 0; k < 7; ++k) {
    const auto column = [&](PlasticPoints &points) -> AtPoints & {
      return k < 6 ? points.metric[k] : points.plastic_strain;
    };
    std::vector<double> values;
    for (PlasticPoints &points : before_)
      values.insert(values.end(), column(points).begin(), column(points).end());
    static const std::array<const char *, 7> names = {
        "plastic_metric_xx", "plastic_metric_yy", "plastic_metric_zz", "plastic_metric_yz",
        "plastic_metric_zx", "plastic_metric_xy", "plastic_strain"};
    archive.same_rows(names[k], values, "1", k < 3 ? above(0) : k < 6 ? any_number() : at_least(0));
    if (archive.reads())
      for (std::size_t n = 0; n < values.size(); ++n)
        column(before_[n / 8])[n % 8] = values[n];
  }
}

void HyperelasticSolid::describe_fibres(Archive &archive) {
  archive("torn_energy", torn_energy_, "J");
  std::vector<double> shares = fibre_shares();
  archive.same_rows("fibre_share", shares, "1", at_least(0));
  for (std::size_t c = 0; c < shares.size(); ++c)
    fibre_cells_[c].share = shares[c];
}

// Forces under the pressures of the last force computation.
void HyperelasticSolid::follow_state() {
  check(displacement_);
  place_surface();
  std::vector<double> acting(acting_);
  std::swap(face_pressure_, acting);
  update_forces();
  std::swap(face_pressure_, acting);
}

} // namespace platen::fem
