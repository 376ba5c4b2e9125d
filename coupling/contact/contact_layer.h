// Contact between the particles and the surface of one body: node to surface, one contact per particle. The
// particle is the node; its sphere touches the closest point of the whole surface, on a face, an edge or a
// vertex, so that force and friction history do not depend on the mesh.
//
// Normal n from body to particle, gap g = distance of the centre - R - offset, positive when open. Force on
// the particle F = N n + T with N = k_n (-g) - c n.v, N >= 0, c = 2 xi sqrt(k m), m the particle's mass (the
// body is assumed to be much heavier); T after dem/laws/friction_law.h with k_t = ratio k_n. It acts at the
// closest point. v is the particle's velocity there, minus the surface's, both over the last drift (half-step
// values: their product with dt is the displacement, and the works below are those of velocity Verlet).
//
// On a deformable mesh, a force with the weights w on the corners of the face has the indentation compliance
// c = w^T C w, which grows as the mesh is refined. Given C, the spring here has only the rest of the
// prescribed stiffness, 1/k_n = 1/k - c: spring and mesh together have k everywhere on a face, and the
// compliance of the body as a whole is additional. That holds up to k c = .46, which elements of five radii
// of the contact reach at their vertices; beyond, less is taken out, and from k c = .85 on nothing: the
// contact is then too soft.
//
// Or Hertz-Mindlin (dem/laws/hertz_on_plane.h): N = 4/3 E* sqrt(R) (-g)^1.5 - c n.v with c = 2 sqrt(5/6) xi
// sqrt(k_n m), which gives the restitution exp(-pi xi / sqrt(1 - xi^2)) where N is not cut off at zero. When
// the tangential spring softens it keeps its stretch, when it stiffens its force, as between grains; the
// energy lost counts as friction. The spring turns about the normal with the mean of sphere and surface.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "base/archive.h"
#include "coupling/contact/layer_kernel.h"
#include "coupling/contact/row_load.h"
#include "coupling/contact/servo_load.h"
#include "coupling/contact/shared_contacts.h"
#include "coupling/contact/surface_search.h"
#include "dem/laws/cohesive_friction.h"
#include "dem/laws/friction_law.h"
#include "dem/laws/hertz_on_plane.h"
#include "dem/particles.h"
#include "dem/stable_step.h"
#include "fem/body.h"

namespace platen::coupling {

enum class Attachment {
  free, // contact only: pushes, slides, opens
  glued // seated particles are tied to the surface: push and pull, no limit to the tangential force
};

// Of seated particles to the face, until it breaks (dem/laws/cohesive_friction.h).
struct SurfaceBond {
  double strength = 0;        // Pa, cohesion in shear; 0: no bond
  double tension = not_given; // Pa, not given: as in shear
  double slip = 0;            // m, at which nothing of it is left; 0: it breaks where it first slides
};

// Frictionless surfaces have no tangential columns.
struct SurfaceContact : dem::SurfaceFriction {
  // N/m, k_n of the whole contact, if linear
  double particle_stiffness = std::numeric_limits<double>::quiet_NaN();
  // Of the whole contact, instead of stiffness and tangential ratio. Excludes glue.
  std::optional<dem::HertzOnPlane> hertz;
  // For a deformable body: the indentations of its mesh under single forces, which the stiffness above
  // already includes and which are therefore taken out of the spring (see above). Empty: none.
  std::vector<fem::FaceCompliance> face_compliance; // m/N, one per face
  double tangential_ratio = 0.8;                    // k_t / k_n, > 0
  double damping = 0;                               // fraction of critical, >= 0
  Attachment attachment = Attachment::free;
  // Its area is that given to bond_seats(). Excludes glue, Hertz and friction of two coefficients.
  SurfaceBond bond;
  // Pa, Young's modulus G_b of the bonds: a seated sphere resists rocking by 2 G_b pi R^3 / 8 per radian up
  // to the moment .5 N R. Zero: no seat. Needs rotation.
  double seat_modulus = 0;
  double skin =
      std::numeric_limits<double>::quiet_NaN(); // m, of the search; a third of the mean radius is good
  dem::InstructionSet instruction_set = dem::best_instruction_set(); // does not change any bit
  bool in_lanes = true; // rows in vectors, where the kernel has all effects of the layer; does not change any
                        // bit
};

// A present contact, for output.
struct ActiveContact {
  int particle = 0;        // row
  int face = 0;            // of the surface
  Vector3 point;           // m, on the surface
  Vector3 normal;          // unit, from body to particle
  double normal_force = 0; // N, positive when pressed; with `glued` also negative
  Vector3 shear;           // N, tangential force on the particle
  bool sliding = false;
  double slip = 0; // m, path slid since the contact closed
};

class ContactLayer final : public SharedContacts {
public:
  // Throws std::invalid_argument, naming the entry, where a parameter is out of range.
  ContactLayer(const dem::Particles &particles, const fem::LoadedSurface &body,
               const SurfaceContact &parameters);
  ~ContactLayer();

  // Seats every particle whose surface lies within `depth` (m) of the body, each at its present gap, as if
  // cut flush with the surface: that gap is then its zero. With `below` it is cut by so much (m) more at its
  // centre, and meets a surface that has come closer by as much. Returns the number. `upright`: only
  // particles whose contact normal is along z. Only particles under the face of a strip are ground; a sphere
  // next to its edge would be seated at an angle, and wedge.
  int seat_within(const dem::Particles &particles, const fem::LoadedSurface &body, double depth,
                  bool upright = false, const std::function<double(const Vector3 &)> &below = {});
  int seats() const;
  // Bonds every seat over its part of `area` (m^2), by its radius squared: as much as its sphere covers of
  // the face. Throws std::invalid_argument where there is none.
  void bond_seats(const dem::Particles &particles, double area);
  // Of the seats, those whose bond has not broken; NaN without bonds.
  double bonded_share() const;

  // Once per step, after the drift: no particle has moved relative to the surface by more than `distance` (m)
  // since the last call. Throws std::runtime_error where that is more than the smallest radius: a particle
  // could have passed through a face undetected.
  void moved(double distance);

  // Lists the particles near the surface if the list is out of date. add_forces does this itself; call it
  // before reading springs or stiffness ahead of the first step.
  void update_search(const dem::Particles &particles, const fem::LoadedSurface &body);
  // The same in any case.
  void make_list(const dem::Particles &particles, const fem::LoadedSurface &body);

  // Force computation: adds contact forces (and torques) to the particles and loads to the body, advances the
  // history by the step dt (s) of the drift. Reads position, velocity, radius, mass (angular_velocity);
  // writes force (torque). Bitwise the same for any number of threads and any time of the search list.
  void add_forces(dem::Particles &particles, fem::LoadedSurface &body, double dt);

  // The force computation in three parts, for callers with other work for idle threads. Returns the number of
  // parts of the contacts that are due:
  std::size_t prepare(const dem::Particles &particles, const fem::LoadedSurface &body);
  // computes the forces of one part, in any order and on any thread, from the present particles and body;
  // writes only the layer's own rows;
  void compute_part(const dem::Particles &particles, const fem::LoadedSurface &body, double dt,
                    std::size_t part);
  // then, once, adds the results to particles and body. Without a body: to the particles alone, for callers
  // that seldom read the body's loads; load_body() gives the loads of the last step.
  void apply_forces(dem::Particles &particles, fem::LoadedSurface *body);
  void load_body(fem::LoadedSurface &body) const;

  // Row of the first particle of a part, after prepare(). Parts are in ascending order of it.
  int particle_of_part(std::size_t part) const;

  // Without a call, prepare() and compute_part() compute all rows.
  void compute_only(const std::vector<char> &own_blocks) override { own_blocks_ = own_blocks; }
  std::size_t most_bytes() const override;
  void put_loads(std::vector<char> &bytes) const override;
  void take_loads(const std::vector<char> &of_all) override;
  void put_rows(std::vector<char> &bytes) const override;
  void take_rows(const std::vector<char> &of_all) override;

  // Of the last add_forces.
  std::vector<ActiveContact> contacts() const; // ascending particle rows
  // Calls visit(face, point in m) for each of them.
  template <class Visit>
  void visit_contacts(const Visit &visit) const {
    for (std::size_t k = 0; k < results_.size(); ++k)
      if (results_.load[k].particle >= 0) visit(results_.load[k].face, results_.contact[k].point);
  }
  double elastic_energy() const { return elastic_energy_; } // J, normal, tangential and seat springs
  // Mean slip of the contacts near each surface vertex (m), with the weights of the force; zero elsewhere.
  std::vector<double> vertex_slip(const fem::LoadedSurface &body) const;

  // Since the start (J).
  double friction_work = 0; // lost to sliding, including rocking seats
  double damping_work = 0;  // lost to dashpots
  std::size_t closed = 0;   // contacts in the last add_forces

  // Springs of all particles near the surface: for the stable step with the largest stiffness anywhere on the
  // face, for equilibria (`with_mesh`) including the indentation of the mesh.
  std::vector<dem::GroundSpring> ground_springs(const dem::Particles &particles,
                                                const fem::LoadedSurface &body, bool with_mesh = false) const;
  // Springs of the same particles on each vertex of the surface.
  fem::VertexSprings vertex_springs(const dem::Particles &particles, const fem::Body &body) const;
  // The resistance to a servo: all particles near the surface, touching or not.
  ServoLoad servo_load(const dem::Particles &particles) const;
  // Hertz: whether an overlap is deeper than the springs have been computed for since allow_for_depth().
  bool stiffened() const { return deepest_ > counted_; }
  // Hertz, before its springs are read: gives all of them the stiffness of the deepest contact now, with a
  // reserve.
  void allow_for_depth();

  const Table &history() const { return table_; } // one row per particle near the surface, ascending
  void describe(Archive &archive);

  std::size_t bytes() const; // of rows and search lists
  const SurfaceContact &parameters() const { return parameters_; }
  // From the next step on. Springs keep their force; a spring above its new limit slides. Throws
  // std::invalid_argument as the constructor does, and where a layer that was made without friction is to get
  // some, because it has no springs.
  void set_friction(const dem::SurfaceFriction &friction);
  const SurfaceSearch &search() const { return search_; }

private:
  struct Kinematics;
  // One row in one step.
  struct RowForce {
    bool active = false;
    int particle = 0;
    SurfacePoint at;
    double normal_force = 0; // N, >= 0 unless tied
    double dashpot = 0;      // N, part of the normal force
    Vector3 shear;           // N
    Vector3 moment;          // N m, of the seat
    dem::CoulombFriction::State spring, seat;
    double tangential_stiffness = 0;                         // N/m
    double bond = 0;                                         // 1, part that is left
    double depth = 0;                                        // 1, overlap over radius
    double idle_until = 0;                                   // m, of travelled_
    double slip = 0;                                         // m
    double elastic = 0, friction_loss = 0, damping_loss = 0; // J
  };
  // One row, sent between ranks.
  struct SharedLoad {
    int row, particle, face;
    std::array<double, 4> weights;
    Vector3 force, point, moment;
    double elastic, friction_loss, damping_loss, depth;
  };
  bool is_own(std::size_t row) const;
  void set_rows(const std::vector<int> &particles);
  void find_due_rows();
  void find_due_rows_again(const std::vector<int> &order, std::size_t old_rows); // as set_rows orders them
  void keep_due(std::size_t count);                                              // keeps the first ones
  std::vector<int> seated_particles() const;
  std::size_t add_row(int particle);
  void seat(int particle, double offset); // m, the gap at rest, negative for an overlap
  // For a force with these weights on the corners of a face: m/N, of the mesh; N/m, of the linear spring
  // without the mesh.
  double indentation(int face, const std::array<double, 4> &weights) const;
  double spring(int face, const std::array<double, 4> &weights) const;
  double stiffness_of(double radius) const; // N/m, of the whole contact of a sphere
  double stiffest_spring(int face, double radius) const;
  double tangential_ratio() const;
  double seat_stiffness(double radius) const; // N m/rad, of a sphere's flat end
  bool tied(std::size_t row) const;
  bool bonded(std::size_t row) const { return bond_ != nullptr && (*bond_)[row] > 0; }
  bool holds_history(std::size_t row) const;
  void compute_in_lanes(const dem::Particles &particles, const fem::LoadedSurface &body, double dt,
                        std::size_t first, std::size_t count, const SurfacePoints &points);
  // Writes the closest point to `result.at`.
  void row_force(const dem::Particles &particles, const fem::LoadedSurface &body, std::size_t row, double dt,
                 RowForce &result);
  void press(const SurfacePoint &at, double mass, Kinematics &motion) const;
  void normal_force(std::size_t row, const Kinematics &motion, double dt, RowForce &result);
  double tangential_spring(std::size_t row, const Kinematics &motion, const Vector3 &stretch, Vector3 &spring,
                           RowForce &result);
  void tangential_force(std::size_t row, const Kinematics &motion, double dt, RowForce &result);
  dem::CohesiveFriction bond_of(double radius) const;
  void pull(double left, Kinematics &motion) const;
  void weaken(std::size_t row, Kinematics &motion, double dt, RowForce &result);
  void seat_moment(std::size_t row, const Kinematics &motion, double dt, RowForce &result);
  void keep_history(std::size_t row, RowForce &result);
  void push_particle(dem::Particles &particles, std::size_t k) const;
  void sum_rows(); // sums over all rows
  void keep_result(std::size_t k, const RowForce &row, const Vector3 &centre);

  SurfaceContact parameters_;
  kernels::ComputeRows compute_rows_ = nullptr; // null: row by row
  double stiffness_ = 0;                        // N/m, of the whole contact
  double bonded_area_ = 0;                      // 1, of a bond over its sphere's radius squared
  double smallest_radius_;
  SurfaceSearch search_;

  Table table_;
  Column<int> &particle_ = table_.add<int>("particle", "1");
  Column<int> &seated_ = table_.add<int>("seated", "1", flag());
  Column<double> &offset_ = table_.add<double>("offset", "m");
  Column<double> &dashpot_ = table_.add<double>("dashpot_force", "N");
  Column<Vector3> *normal_ = nullptr;              // where there is a tangential or seat spring
  Column<Vector3> *spring_ = nullptr;              // N; with friction or glue
  Column<int> *sliding_ = nullptr;                 // the same
  Column<double> *slip_ = nullptr;                 // m, the same
  Column<double> *tangential_stiffness_ = nullptr; // N/m, the same; only of Hertz, where it changes
  Column<double> *bond_ = nullptr;                 // 1, part that is left; with a bond
  Column<Vector3> *seat_spring_ = nullptr;         // N m; with seats
  Column<int> *seat_sliding_ = nullptr;

  std::vector<char> own_blocks_;   // empty: all
  double travelled_ = 0;           // m, sum of the distances given to moved()
  std::vector<double> idle_until_; // for each row: no contact while travelled_ is less
  std::vector<std::size_t> due_;   // rows to compute in this step
  RowResults results_;             // of the due rows
  std::vector<Vector3> moments_;   // N m, of the due rows; with seats
  double elastic_energy_ = 0;
  // Hertz, overlap over radius: largest in the last step, and the one that springs are computed for.
  double deepest_ = 0, counted_ = 0;
};

} // namespace platen::coupling
