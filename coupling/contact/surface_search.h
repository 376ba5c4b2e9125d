// The particles near a body's surface, and the closest point of the surface to each.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "base/vector3.h"
#include "coupling/contact/closest_kernel.h"
#include "coupling/contact/closest_point.h"
#include "coupling/contact/faces.h"
#include "coupling/contact/surface_point.h"
#include "dem/particles.h"
#include "fem/surface.h"

namespace platen::coupling {

struct Box {
  Vector3 low, high; // m

  void include(const Vector3 &p);
  void include(const Box &b);
  double distance_squared(const Vector3 &p) const; // m^2, zero inside
};

class BoxTree {
public:
  // Splits by the median of the longest side. O(n log n).
  explicit BoxTree(const std::vector<Box> &boxes);
  // The same tree around boxes that have moved. O(n).
  void refit(const std::vector<Box> &boxes);

  // visit(index) for every box, nearest halves first, that is within the present limit (m^2) of the point;
  // visit may lower the limit, which was given by reference.
  template <class Visit>
  void near(const Vector3 &point, double &limit_squared, const Visit &visit) const {
    if (!nodes_.empty()) descend(0, point, limit_squared, visit);
  }

private:
  struct Node {
    Box box;
    int left = -1, right = -1; // nodes; a leaf has none
    int item = -1;             // of a leaf
  };
  int build(const std::vector<Box> &boxes, std::vector<int> &items, std::size_t first, std::size_t last);
  template <class Visit>
  void descend(int index, const Vector3 &point, double &limit_squared, const Visit &visit) const {
    const Node &node = nodes_[static_cast<std::size_t>(index)];
    if (node.box.distance_squared(point) > limit_squared) return;
    if (node.item >= 0) return visit(node.item);
    int near_side = node.left, far_side = node.right;
    if (nodes_[static_cast<std::size_t>(far_side)].box.distance_squared(point) <
        nodes_[static_cast<std::size_t>(near_side)].box.distance_squared(point))
      std::swap(near_side, far_side);
    descend(near_side, point, limit_squared, visit);
    descend(far_side, point, limit_squared, visit);
  }

  std::vector<Node> nodes_; // parents before children
};

const Vector3 &vertex_at(const fem::SurfaceMesh &surface, int vertex); // m

// Corners of a face relative to a point.
Quad face_corners(const fem::SurfaceMesh &surface, int face, const Vector3 &origin);

class SurfaceSearch {
public:
  // The surface keeps its faces for the life of the search; its vertices may move. skin (m): relative
  // displacement of particles and surface until the list is rebuilt; a larger skin means fewer and longer
  // lists.
  SurfaceSearch(const fem::SurfaceMesh &surface, double skin,
                dem::InstructionSet instruction_set = dem::best_instruction_set());

  double skin() const { return skin_; }
  // States that no particle has moved relative to the surface by more than `distance` (m) since the last
  // call: largest particle displacement plus largest surface displacement.
  void moved(double distance) {
    travelled_ += distance;
    looked_ = false;
  }
  void forget() { travelled_ = std::numeric_limits<double>::infinity(); }
  bool stale() const { return stale_after(0); }
  bool stale_after(double distance) const { return !(travelled_ + distance <= skin_); }

  // Lists all particles whose centre is within reach[row] + skin of the surface, and those in `always`
  // (ascending rows) at any distance. Visits every particle once.
  void rebuild(const fem::SurfaceMesh &surface, const Column<Vector3> &position,
               const std::vector<double> &reach, const std::vector<int> &always);

  // Sets up the faces near particles in their present positions, so that closest() need not do so for each
  // particle until moved() is called again. Does nothing for a surface that only shifts.
  void update(const fem::SurfaceMesh &surface);

  long lists_made() const { return lists_made_; }
  // Rows of the listed particles, ascending.
  const std::vector<int> &particles() const { return particles_; }

  // Closest point of the whole surface for entry k of the list and the present centre. Exact while the list
  // is not stale, and independent of when the list was made. Ties go to the lowest face. May be called from
  // several threads.
  SurfacePoint closest(const fem::SurfaceMesh &surface, std::size_t k, const Vector3 &centre) const;

  // The same for `count` entries, at most SurfacePoints::most, with the centres centre[at[k]]; reads one more
  // centre. In vectors, to the same bits.
  void closest(const fem::SurfaceMesh &surface, const std::size_t *entry, const Vector3 *centre,
               const int *at, std::size_t count, SurfacePoints &points) const;

  // The same by a search over all faces: the reference of the tests, and suitable for a single query.
  SurfacePoint closest_of_all(const fem::SurfaceMesh &surface, const Vector3 &centre) const;

  std::size_t bytes() const {
    return particles_.capacity() * sizeof(int) + first_near_.capacity() * sizeof(std::size_t) +
           near_.capacity() * sizeof(NearFace);
  }

private:
  // Distances are compared with this relative margin, so that round-off never drops the face that is closest.
  static constexpr double margin = 1e-9;
  struct NearFace {
    double distance = 0; // m, when the list was made
    int face = 0;
  };
  std::vector<Box> face_boxes(const fem::SurfaceMesh &surface) const;
  void collect(const fem::SurfaceMesh &surface, const Vector3 &centre, double limit);
  SurfacePoint closest_listed(const fem::SurfaceMesh &surface, std::size_t k, const Vector3 &centre) const;
  bool is_nearest(std::size_t k, const Vector3 &centre, double distance_squared) const;
  // On one face; true where the normal was computed too. `moving`: null on surfaces that only shift.
  bool nearest_on(const fem::SurfaceMesh &surface, int face, const Vector3 &centre, const MovingFace *moving,
                  SurfacePoint &nearest) const;
  Vector3 from_corner(const fem::SurfaceMesh &surface, int face, const Vector3 &centre) const;
  bool closest(const fem::SurfaceMesh &surface, int face, const Vector3 &centre, SurfacePoint &result) const;
  void set_flat_point(int face, const FlatPoint &closest, SurfacePoint &result) const;
  void closest_on_flat(const fem::SurfaceMesh &surface, const std::size_t *entry, const Vector3 *centre,
                       const int *at, std::size_t count, SurfacePoints &points) const;
  int first_face(std::size_t k) const { return near_[first_near_[k]].face; }
  bool others_are_farther(std::size_t k, int face, double distance) const;
  bool closest_on_nearest(const fem::SurfaceMesh &surface, std::size_t k, const Vector3 &centre,
                          SurfacePoint &result) const;
  SurfacePoint with_normal(const fem::SurfaceMesh &surface, int face, const ClosestPoint &local,
                           const Vector3 &centre) const;
  Vector3 edge_normal(const fem::SurfaceMesh &surface, int face, const ClosestPoint &local,
                      const Vector3 &centre) const;
  Vector3 vertex_normal(const fem::SurfaceMesh &surface, int face, int corner, const Vector3 &centre) const;

  double skin_;
  kernels::FindClosestPoints find_closest_points_;
  kernels::FindFlatClosestPoints find_flat_closest_points_;
  kernels::SetFaces set_faces_;
  double travelled_ = std::numeric_limits<double>::infinity();
  BoxTree tree_;
  FlatFaces flat_;
  std::vector<std::vector<int>> faces_of_vertex_;
  long lists_made_ = 0;
  std::vector<int> particles_;
  std::vector<std::size_t> first_near_; // entry k has near_[first_near_[k] ... first_near_[k + 1])
  std::vector<NearFace> near_;          // ascending distance
  std::vector<int> near_faces_;         // all of them once, ascending
  std::vector<MovingFace> moving_;      // of all faces; those near particles are up to date if looked_
  bool looked_ = false;
};

} // namespace platen::coupling
