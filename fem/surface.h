// The outer surface of a body as plain arrays, and loads on its vertices: all that the contact layer needs of
// a body.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"

namespace platen::fem {

// Quadrilaterals with their vertices counter-clockwise seen from outside the body, so that
// (v1 - v0) x (v3 - v0) points out of the solid. No duplicate vertices: faces that share a corner share its
// index.
struct SurfaceMesh {
  std::vector<Vector3> vertices;         // m, current
  std::vector<Vector3> velocities;       // m/s, one per vertex
  std::vector<std::array<int, 4>> faces; // vertex indices
  std::vector<int> face_tags;            // boundary id of each face (0 unless the body gives another)
  // The vertices are those of the start plus one common displacement, and have one velocity.
  bool only_shifted = false;
};

// A surface whose vertices are nodes of a body.
struct NodeSurface {
  SurfaceMesh surface;   // velocities zero
  std::vector<int> node; // of each vertex, ascending
};
// Reduces a surface whose vertices are all nodes of the body to the nodes of its faces.
NodeSurface node_surface(const SurfaceMesh &all);

// (i, j): normal displacement of corner i of a face per normal force on corner j (m/N); symmetric. A point
// whose forces go to the corners with the weights w has the compliance w^T C w.
using FaceCompliance = std::array<std::array<double, 4>, 4>;

// Area times mean outward normal of a face (m^2): exact for the bilinear face, flat or warped.
Vector3 face_area_vector(const SurfaceMesh &surface, std::size_t face);

// The faces around each vertex, ascending; a triangle, written as a quad with one corner twice, counts once.
std::vector<std::vector<int>> faces_of_vertices(const SurfaceMesh &surface);

// Faces without area (|area vector| below 1e-12 of their longest diagonal squared), which have no normal.
std::vector<int> zero_area_faces(const SurfaceMesh &surface);

class LoadedSurface {
public:
  const SurfaceMesh &surface() const { return surface_; }

  // Loads on the surface (N), accumulated in the order of the calls.
  void clear_loads();
  void add_surface_force(int vertex, const Vector3 &force) {
    const std::size_t v = static_cast<std::size_t>(vertex);
    if (!is_loaded_[v]) loaded_.push_back(vertex);
    is_loaded_[v] = 1;
    load_[v] = load_[v] + force;
  }
  // A force at a point of a face, distributed to its corners by these weights.
  void add_face_force(int face, const std::array<double, 4> &weights, const Vector3 &force) {
    const std::array<int, 4> &corners = surface_.faces[static_cast<std::size_t>(face)];
    for (std::size_t k = 0; k < 4; ++k)
      add_surface_force(corners[k], weights[k] * force);
  }
  const Vector3 &contact_load(int vertex) const { return load_[static_cast<std::size_t>(vertex)]; }
  const std::vector<Vector3> &contact_loads() const { return load_; } // N, one per vertex
  const std::vector<int> &loaded_vertices() const { return loaded_; } // in the order of their first load
  Vector3 total_force() const;                                        // N
  Vector3 moment(const Vector3 &about) const;                         // N m

  // Loads as tractions, one per surface vertex: the load over the vertex's area on the side that it presses
  // on (a vertex on the rim of a plate lies on two sides). Their sum over that area is the load.
  struct Traction {
    double pressure = 0; // Pa, positive when pressed
    Vector3 shear{};     // Pa, along the side
    Vector3 area{};      // m^2 times outward normal
  };
  std::vector<Traction> contact_tractions() const;

protected:
  LoadedSurface() = default;
  // Sets the surface, without loads. Throws std::invalid_argument where a face has no area (naming it).
  void set_surface(SurfaceMesh surface);

  // Loads as part of a state, in the order of their first one. Throws StateError, without changes, where a
  // vertex does not exist.
  void describe_loads(Archive &archive);

  SurfaceMesh surface_;
  std::vector<Vector3> load_;   // N, one per vertex
  std::vector<int> loaded_;     // vertices with a load, in the order of their first one
  std::vector<char> is_loaded_; // one per vertex
};

} // namespace platen::fem
