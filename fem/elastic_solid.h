// A linear elastic body: its surface touches the particles, its clamp connects it to a machine. Strain is
// small, motion may be large: deformation is measured in the frame of the clamp, so that translation and
// rotation by the machine cause no stress.
//
// Position of node i: x = X + carried + R u, with u its displacement in the frame's axes. Internal forces are
// -R K u. The clamp takes the reaction force and moment of the free nodes, so that momentum and angular
// momentum are conserved exactly.
//
// Explicit: central differences with lumped mass. Loads act as impulses (kick) before and after a drift,
// which takes as many substeps as it needs under internal forces alone (impulses of two step sizes:
// Grubmueller et al. 1991, Tuckerman et al. 1992): second order in both steps, and velocity Verlet with one
// substep. Quasi-static: no inertia of deformation; solve_for() solves for the shape under given loads, drift
// moves to it at constant velocity.
//
// Explicit: a material with a hardening yields (yielding_cells.h).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/vector3.h"
#include "fem/body.h"
#include "fem/elastic_model.h"
#include "fem/node_matrix.h"
#include "fem/static_equations.h"
#include "fem/yielding_cells.h"

namespace platen::fem {

constexpr int no_clamp = -1;

// Connection to the machine: all components of the nodes on the faces of one tag are prescribed.
struct Clamp {
  int tag = high_end_tag; // no_clamp: a free body with a fixed frame (small motion; explicit only)
  // Free to rotate about the seat, which the machine moves: the frame rotates as a rigid rotor under the
  // moment on the clamp (explicit) or of all loads (quasi-static).
  bool turns = false;
  Vector3 seat{}; // m, centre of the spherical seat at the start
  // Unit vector of free sliding: the clamp, with the attached mass, moves under the body's reaction and
  // push(). Zero: the machine prescribes the motion. Quasi-static: with the mass of the whole body.
  Vector3 slides{};
};

enum class ElasticMotion { explicit_steps, quasi_static };

struct ElasticOptions {
  int degree = 1;
  ElasticMotion motion = ElasticMotion::explicit_steps;
  double mass_damping = 0;      // 1/s, decay rate of velocities relative to the frame; explicit
  double stiffness_damping = 0; // s, damping matrix over stiffness matrix (Rayleigh); explicit
  double fastest_damping =
      0; // fraction of critical damping added to the fastest mode by stiffness damping; explicit
  LinearSolver solver = LinearSolver::automatic;
};

// Every node of the boundary is a vertex of the surface.
class ElasticSolid : public Body {
public:
  // Materials by material id of the cells. Throws std::invalid_argument as make_elastic_model does, and where
  // no face has the clamp's tag, an option is out of range or two options exclude each other.
  ElasticSolid(const Grid &grid, std::vector<Material> materials, const Clamp &clamp,
               const ElasticOptions &options = {});

  const ElasticModel &model() const { return model_; }
  const std::vector<int> &clamped_nodes() const { return clamped_nodes_; }
  double mass() const override { return mass_; } // kg

  // Motion of the frame, as that of a rigid body about its centre of mass. A clamp that turns freely rotates
  // about its seat instead; the first form then keeps its angular velocity.
  void set_velocity(const Vector3 &velocity) override;                           // m/s
  void set_velocity(const Vector3 &velocity, const Vector3 &angular_velocity);   // m/s; rad/s, global axes
  const Vector3 &velocity() const override { return velocity_; }                 // m/s, of centre or seat
  const Vector3 &angular_velocity() const override { return angular_velocity_; } // rad/s
  const Vector3 &displacement() const override { return displacement_; }         // m, of centre or seat
  Vector3 centre() const { return pivot_ + displacement_; } // m, centre of mass of the frame, or seat
  const Quaternion &rotation() const override { return rotation_; }
  bool turns() const override { return clamp_.turns; }

  // For a sliding clamp: attach() fixes a further `mass` (kg) to it, before the first step; sliding_mass()
  // includes it. push() applies an impulse (N s) along `slides`; its work counts as work of the loads.
  void attach(double mass) { sliding_mass_ += mass, attached_mass_ = mass; }
  double sliding_mass() const { return sliding_mass_; }                     // kg
  double sliding_velocity() const { return dot(velocity_, clamp_.slides); } // m/s
  void push(double impulse);

  void kick(double dt) override; // impulse of the loads over dt (s)
  // Moves everything over dt in steps of at most 0.9 of the stable step. Surface velocities are then means
  // over the path: displacement of each vertex divided by dt.
  void drift(double dt) override;
  void drift(double dt, int substeps);
  double stable_step() const { return stable_step_; } // s, of explicit steps; infinite for quasi-static
  double stable_step(const VertexSprings &springs) const override;
  std::vector<FaceCompliance> face_compliance() const override; // see fem/elastic_model.h; at the start
  int substeps(double dt) const;                                // number in drift(dt)
  double last_move() const override { return last_move_; }

  // Quasi-static: solves for the shape under loads (N, global axes, one per vertex: a mean over the time
  // since the last call) and moves to it at constant velocity over `duration` (s); 0: at once, with zero
  // velocity. Throws std::logic_error for an explicit body.
  void solve_for(const std::vector<Vector3> &vertex_loads, double duration);
  // Stiffness of the contacts that load each vertex (N/m, at least half of the true value). solve_for() with
  // a duration then includes these springs, anchored at the mean position of the body under the loads.
  // Without them the loads oscillate with growing amplitude from solve to solve where the body is softer than
  // its contacts. At rest they have no effect. Quasi-static, before the first solve_for().
  void set_support(const std::vector<double> &vertex_stiffness);
  // Number of solves until the supported body is within 1/e of its final position along a direction (unit,
  // frame's axes): about 2 + 3/2 D/K for springs D on a body K. After set_support().
  double solves_behind(const Vector3 &direction);
  LinearSolver solver_kind() const; // direct or multigrid, once solve_for() was called

  double kinetic_energy() const; // J
  EnergyBalance energy_balance() const override;

  // Equivalent, mean of each cell's points; empty where no material yields.
  std::vector<double> plastic_strains() const {
    return yielding_ ? yielding_->strains() : std::vector<double>{};
  }

  // Displacement of each node relative to the frame, in the frame's axes (m).
  std::vector<Vector3> deformation() const;

  // Call it between steps.
  void describe(Archive &archive) override;

  // Stresses are in the frame's axes, per material.
  Picture picture(const std::vector<double> &slip = {}) const override;

private:
  bool is_static() const { return options_.motion == ElasticMotion::quasi_static; }
  void hold(const Clamp &clamp);
  void weigh_rotor();
  void weigh_clamp();
  void follow_state();

  // Frame.
  Vector3 to_frame(const Vector3 &v) const { return turned_ ? rotate(conjugate(rotation_), v) : v; }
  Vector3 to_space(const Vector3 &v) const { return turned_ ? rotate(rotation_, v) : v; }
  Vector3 carried(std::size_t node) const; // m, displacement of a node that moves with the frame
  Vector3 arm(std::size_t node) const { return model_.nodes[node] + moved_[node] - centre(); }
  Vector3 carried_velocity(const Vector3 &arm_of_node) const {
    return velocity_ + cross(angular_velocity_, arm_of_node);
  }
  bool slides() const { return clamp_.slides != Vector3{}; }
  bool moves_by_itself() const { return turns() || slides(); } // the clamp
  bool is_held(std::size_t node) const { return fixed_[node][0] != 0; }
  Vector3 free_part(std::size_t node, const Vector3 &v) const { return is_held(node) ? Vector3{} : v; }
  void move_frame(double dt);
  void find_angular_velocity();
  void place_held();
  void place_surface();
  double held_kinetic_energy() const;

  // Explicit steps.
  void substep(double dt);
  void find_internal_forces(bool yields);
  void internal_kick(double dt);
  void damp(double dt);
  void give_to_clamp(double dt, const Vector3 &force, const Vector3 &moment);
  void slide(double impulse);

  // Quasi-static.
  double path_fraction() const { return duration_ > 0 ? elapsed_ / duration_ : 1.0; } // fraction of the path
  double path_strain() const;
  void measure_path();
  void drift_evenly(double dt);

  ElasticModel model_;
  Clamp clamp_;
  ElasticOptions options_;
  std::vector<int> node_of_, clamped_nodes_;
  Fixed fixed_; // all components of a node, or none
  double mass_ = 0, stable_step_ = 0;
  double sliding_mass_ = 0, attached_mass_ = 0; // kg
  Vector3 pivot_{};                             // m, centre of mass or seat at the start
  Matrix3 rotor_{};                             // kg m^2 about the seat, frame's axes, of the rigid rotor
  Matrix3 rotor_inverse_{};
  Vector3 rotor_arm_{}; // kg m, its first moment, frame's axes

  Vector3 displacement_{}, velocity_{}, angular_velocity_{}, spin_{}; // spin_: angular momentum of the rotor
  Quaternion rotation_;
  bool turned_ = false;
  std::vector<Vector3> moved_, rate_;     // m, m/s per node, global axes; explicit
  std::vector<Vector3> strained_, force_; // m and N per node: u, and internal forces in global axes
  std::optional<YieldingCells> yielding_; // none: all materials are elastic
  std::vector<Vector3> start_, target_;   // m per node, frame's axes; quasi-static
  double elapsed_ = 0, duration_ = 0;     // s since the start of the path, and its total
  bool on_the_path_ = false;              // whether the last drift deformed the body
  std::array<double, 3> path_{};          // J: strain energy is path[0] + s path[1] + s^2 path[2] along it
  double last_step_ = 0, last_move_ = 0;
  double load_work_ = 0, clamp_work_ = 0;
  double dissipated_ = 0; // J; quasi-static: work on the deformation less strain energy
  struct Kicked {
    std::size_t node;
    Vector3 gain, before; // m/s
  };
  std::vector<Kicked> kicked_;          // nodes with loads since the last drift
  double pushed_ = 0;                   // N s, the same for a sliding clamp
  std::vector<StaticEquations> solver_; // none until the first solve_for()
  std::vector<double> support_;         // N/m per node; empty without support
  NodeMatrix supported_;                // stiffness and support
  std::vector<StaticEquations> supported_solver_;
};

} // namespace platen::fem
