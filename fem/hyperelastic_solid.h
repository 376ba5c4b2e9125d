// A solid at finite strain, of rubber, of metal that yields or of fibres in resin: the sleeve, the tube or
// the wrap around a specimen, or a block. Nodes carry mass and motion, cells give the internal forces, faces
// of a tag carry a follower pressure (hyperelastic_cell.h), and one part of the surface touches the
// particles, as a Body's does.
//
// Explicit: velocity Verlet, in the order half_kick, drift, [contact loads], update_forces, half_kick. An
// element that would be inverted is found at its new position before the law is evaluated, and the solid does
// not move.
//
// Signs: pressure positive when it pushes into the solid; works positive when done on the solid.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/node_matrix.h"
#include "fem/picture.h"
#include "fem/solid_mesh.h"
#include "fem/surface.h"

namespace platen::fem {

struct SolidMaterial {
  double density; // kg/m^3, positive
  NeoHookean law;
  std::optional<Hardening> hardening{}; // of metal; none: it does not yield
  std::optional<Fibres> fibres{};       // in a resin of this law; none: rubber or metal
};

// Thrown before an inverted element is used; the text gives cell, position, volume ratio and load.
struct InvertedElement : std::runtime_error {
  InvertedElement(const std::string &what, int cell_, const Vector3 &place_, double volume_ratio_)
      : std::runtime_error(what), cell(cell_), place(place_), volume_ratio(volume_ratio_) {}
  int cell;
  Vector3 place; // m, middle of the cell at its new position
  double volume_ratio;
};

class HyperelasticSolid : public LoadedSurface {
public:
  // `contact_tags`: the part of the surface that touches the particles (inner_tag for a sleeve: its outer
  // face then has no contacts); empty for all of it. Throws std::invalid_argument where a constant is out of
  // range, a cell is folded or a tag has no faces.
  HyperelasticSolid(const Grid &grid, const SolidMaterial &material,
                    const std::vector<int> &contact_tags = {});

  const SolidMaterial &material() const { return material_; }
  const SolidMesh &mesh() const { return mesh_; }
  double volume() const { return volume_; }                                // m^3, without load
  double mass() const { return material_.density * volume_; }              // kg
  std::vector<int> nodes_of(int tag) const { return mesh_.nodes_of(tag); } // ascending

  // surface() is the part that touches the particles: current vertices and velocities, outward normals of the
  // solid (those of the inner face of a tube point to the axis).
  int surface_node(int vertex) const { return surface_node_[static_cast<std::size_t>(vertex)]; }
  double surface_mass(int vertex) const { return mass_[index(surface_node(vertex))]; } // kg
  double largest_move(double dt) const; // m, upper bound of node displacements in a drift over dt

  // Prescribes the motion of nodes in some of the components x, y, z: all for an end that is bonded to a
  // platen, z alone for one that slides along it. Returns the number of the motion. Throws where a component
  // of a node is prescribed already.
  int prescribe(const std::vector<int> &nodes, const std::array<bool, 3> &components);
  // m/s; rad/s about a point (m). Takes effect at the next half_kick, with the node positions at that time:
  // call it again each step while a prescribed motion rotates.
  void set_prescribed_velocity(int motion, const Vector3 &velocity, const Vector3 &spin = {},
                               const Vector3 &about = {});
  // From now on set_node_velocities prescribes the velocity of each node: an end that rotates. Until its
  // first call the velocities do not change.
  void prescribe_each(int motion);
  // m/s, in the order of the nodes; takes effect at once. The work of velocity jumps is the machine's.
  void set_node_velocities(int motion, const std::vector<Vector3> &velocities);
  Vector3 prescribed_force(int motion) const; // N, of the machine on the solid, without inertia

  // Pa, on all faces of a tag from now on. Throws where no face has it.
  void set_pressure(int tag, double pressure);
  double pressure(int tag) const; // Pa; 0 where none was set
  // m^3, inside the faces of a tag, closed by flat lids over its rims (exact where the rims are plane).
  double enclosed_volume(int tag) const;

  // Rate of mass-proportional damping (1/s): a force of -rate times momentum on free nodes.
  void set_damping(double rate);

  // Explicit steps. drift() throws InvertedElement and leaves everything as it was before the call.
  void half_kick(double dt); // over dt/2, s
  // `looked`: can_drift() has returned true for this drift, to round-off.
  void drift(double dt, bool looked = false);
  bool can_drift(double dt) const; // false where an element would be inverted
  // Moves the surface alone to its position after a drift over dt: for callers that step the solid rarely and
  // read its surface often.
  void place_surface_ahead(double dt);
  // Internal and pressure forces at the current positions. Metal yields from where it was at the last
  // drift(), and fibres rupture there by the strain of the last forces: calls without one give the same
  // forces again.
  void update_forces();
  // s; from the largest eigenvalue of the assembled stiffness, load stiffness included, to 1 % and on the
  // safe side (node_matrix.h). Costs as much as 30 steps: call it rarely. Contact springs are not included:
  // see surface_mass().
  double stable_step() const;

  double kinetic_energy() const;  // J
  double internal_energy() const; // J, stored, as of the last update_forces
  double plastic_work() const;    // J, lost to yielding since the start, as of the last update_forces
  // Equivalent, mean of each cell's points; empty where nothing yields.
  std::vector<double> plastic_strains() const;
  // Of wraps, one per cell, as of the last update_forces: nominal strain of the hoop fibres, and the share of
  // the laminate that is there (0: torn). Empty without fibres.
  const std::vector<double> &fibre_strains() const { return fibre_strain_; }
  std::vector<double> fibre_shares() const;
  double torn_energy() const { return torn_energy_; } // J, stored in what tore, lost since the start
  // Since the start (J). Pressure work is the swept volume times the mean of the pressures of the last forces
  // and of the next ones, as in velocity Verlet.
  double pressure_work() const { return pressure_work_; }
  double prescribed_work() const { return prescribed_work_; }
  double damping_work() const { return damping_work_; } // lost, positive

  const std::vector<Vector3> &displacement() const { return displacement_; } // m, one per node
  const std::vector<Vector3> &velocity() const { return velocity_; }         // m/s
  const std::vector<Vector3> &internal_forces() const { return internal_; }  // N, derivative of the energy
  const std::vector<Vector3> &pressure_forces() const { return pressed_; }   // N
  const std::vector<double> &nodal_mass() const { return mass_; }            // kg
  Vector3 node_place(int node) const { return mesh_.nodes[index(node)] + displacement_[index(node)]; } // m
  // Sets all node positions and updates the forces; counts no work, and metal yields from where it was at the
  // last drift() or yield_here(). Throws InvertedElement, then nothing has changed.
  void set_displacement(const std::vector<Vector3> &displacement);
  // Metal: the next forces start from the plastic strain that the last ones found. Fibres rupture where the
  // last forces found their limit.
  void yield_here();

  // Cauchy stress (Pa), tension positive. Node values are means over the adjacent cells by current volume.
  std::vector<CellStress> cell_stresses() const;
  std::vector<Tensor> node_stresses() const;
  // The elements in their current position, with what Body::picture has, pressure (Pa, minus the mean stress)
  // and J (volume ratio of the element).
  Picture picture(const std::vector<double> &slip = {}) const;

  // All values that change in a run: motion, prescribed velocities, pressures, loads, works. The solid must
  // have the same prescribed motions. Throws InvertedElement where an element would be inverted.
  void describe(Archive &archive);

private:
  static constexpr std::size_t cell_grain = 64; // per part of a loop: some tens of microseconds

  struct PrescribedMotion {
    std::vector<int> nodes;
    std::array<bool, 3> components;
    Vector3 velocity{}, spin{}, about{};
    bool each = false; // each node keeps its own velocity
  };
  struct Worst {
    int cell = -1; // none
    double volume_ratio = 1;
  };

  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  const PrescribedMotion &prescribed_motion(int motion) const;
  void give_velocity(const PrescribedMotion &motion, int node, const Vector3 &given);
  bool is_prescribed(std::size_t node, std::size_t component) const {
    return (prescribed_[node] >> component & 1) != 0;
  }
  Vector3 out_of_balance(std::size_t node) const {
    return node_load(node) + pressed_[node] - internal_[node];
  }
  Vector3 node_load(std::size_t node) const {
    return vertex_of_[node] < 0 ? Vector3{} : load_[index(vertex_of_[node])];
  }
  void describe_yielding(Archive &archive);
  void describe_fibres(Archive &archive);
  void tear(const std::vector<Vector3> &next);
  CellStress stress_of(std::size_t cell) const;
  // The inverted cell with the lowest number for this displacement.
  Worst first_inverted(const std::vector<Vector3> &displacement) const;
  Vector3 cell_middle(int cell, const std::vector<Vector3> &displacement) const;
  std::string words_of_loads() const;
  void check(const std::vector<Vector3> &displacement) const; // throws InvertedElement
  double pressure_work_to(const std::vector<Vector3> &displacement,
                          const std::vector<double> &pressures) const;
  void add_pressure_forces();
  CellStiffness total_stiffness(std::size_t cell) const; // includes the pressure on its faces
  void lay_out_stiffness();
  void assemble(const std::vector<CellStiffness> &cells, NodeMatrix &rows) const;
  FaceCorners face_places(const BoundaryFace &face, const std::vector<Vector3> &displacement) const;
  void place_surface();
  void follow_state();

  SolidMaterial material_;
  SolidMesh mesh_;
  std::vector<int> surface_node_;       // of each vertex
  std::vector<int> vertex_of_;          // of each node, -1 where it is not on the surface
  std::vector<std::size_t> first_face_; // of each cell in mesh_.faces, and the end
  double volume_ = 0;
  std::vector<double> mass_; // kg, of each node
  NodeMatrix stiffness_;     // layout only

  std::vector<Vector3> displacement_, velocity_, next_;
  std::vector<unsigned char> prescribed_; // bits x, y, z of each node
  std::vector<PrescribedMotion> prescribed_motions_;
  std::vector<double> face_pressure_; // Pa, of each face in mesh_.faces
  std::vector<double> acting_;        // Pa, the same for the current forces
  double damping_ = 0;

  std::optional<J2Plasticity> plastic_;
  std::vector<PlasticPoints> before_, after_; // of each cell, around the last update_forces; empty: rubber
  std::vector<FibreCell> fibre_cells_;        // empty: no fibres
  std::vector<double> fibre_strain_;
  double torn_energy_ = 0;
  std::vector<CellForce> cell_force_;
  std::vector<Vector3> internal_, pressed_; // N, of each node
  double pressure_work_ = 0, prescribed_work_ = 0, damping_work_ = 0;
};

} // namespace platen::fem
