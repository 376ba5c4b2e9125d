#include "fem/surface.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/state.h"

namespace platen::fem {

namespace {

// A face has no area below this fraction of its squared diagonal; needles of aspect 1e-9 still have a normal.
constexpr double empty_face = 1e-12;

Vector3 corner(const SurfaceMesh &surface, std::size_t face, std::size_t k) {
  return surface.vertices[static_cast<std::size_t>(surface.faces[face][k])];
}

// Areas that belong to each vertex (m^2 times normal), one entry per side that the vertex lies on: a vertex
// on the rim of a plate is loaded on one side of it, and only that side's area carries the load.
std::vector<std::map<int, Vector3>> tributary_areas(const SurfaceMesh &surface) {
  std::vector<std::map<int, Vector3>> areas(surface.vertices.size());
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (const int v : surface.faces[f]) {
      Vector3 &area = areas[static_cast<std::size_t>(v)][surface.face_tags[f]];
      area = area + 0.25 * face_area_vector(surface, f);
    }
  return areas;
}

// The side whose normal is closest to the direction of the load carries it.
LoadedSurface::Traction traction(const std::map<int, Vector3> &sides, const Vector3 &load) {
  LoadedSurface::Traction result;
  bool found = false;
  double best = 0;
  for (const auto &[tag, area] : sides) {
    const double size = norm(area);
    if (size <= 0) continue;
    const Vector3 normal = (1.0 / size) * area;
    const double pressing = -dot(load, normal);
    if (found && pressing <= best) continue;
    found = true;
    best = pressing;
    result.pressure = pressing / size;
    result.shear = (1.0 / size) * (load + pressing * normal);
    result.area = area;
  }
  return result;
}

} // namespace

NodeSurface node_surface(const SurfaceMesh &all) {
  NodeSurface result;
  std::vector<int> vertex(all.vertices.size(), -1);
  for (const auto &face : all.faces)
    for (const int node : face)
      vertex[static_cast<std::size_t>(node)] = 0;
  for (std::size_t n = 0; n < vertex.size(); ++n) {
    if (vertex[n] < 0) continue;
    vertex[n] = static_cast<int>(result.node.size());
    result.node.push_back(static_cast<int>(n));
    result.surface.vertices.push_back(all.vertices[n]);
  }
  result.surface.faces = all.faces;
  for (auto &face : result.surface.faces)
    for (int &corner : face)
      corner = vertex[static_cast<std::size_t>(corner)];
  result.surface.face_tags = all.face_tags;
  result.surface.velocities.assign(result.node.size(), Vector3{});
  return result;
}

Vector3 face_area_vector(const SurfaceMesh &surface, std::size_t face) {
  const Vector3 first = corner(surface, face, 2) - corner(surface, face, 0);
  const Vector3 second = corner(surface, face, 3) - corner(surface, face, 1);
  return 0.5 * cross(first, second);
}

std::vector<std::vector<int>> faces_of_vertices(const SurfaceMesh &surface) {
  std::vector<std::vector<int>> around(surface.vertices.size());
  for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face)
    for (const int v : surface.faces[static_cast<std::size_t>(face)]) {
      std::vector<int> &faces = around[static_cast<std::size_t>(v)];
      if (faces.empty() || faces.back() != face) faces.push_back(face);
    }
  return around;
}

std::vector<int> zero_area_faces(const SurfaceMesh &surface) {
  std::vector<int> empty;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Vector3 a = corner(surface, f, 2) - corner(surface, f, 0);
    const Vector3 b = corner(surface, f, 3) - corner(surface, f, 1);
    const double area = norm(face_area_vector(surface, f));
    if (!(area > empty_face * std::max(dot(a, a), dot(b, b)))) empty.push_back(static_cast<int>(f));
  }
  return empty;
}

void LoadedSurface::set_surface(SurfaceMesh surface) {
  const std::vector<int> empty = zero_area_faces(surface);
  if (!empty.empty())
    throw std::invalid_argument("body: surface face " + std::to_string(empty[0]) + " has no area");
  surface_ = std::move(surface);
  load_.assign(surface_.vertices.size(), Vector3{});
  is_loaded_.assign(surface_.vertices.size(), 0);
  loaded_.clear();
}

void LoadedSurface::clear_loads() {
  for (const int v : loaded_) {
    load_[static_cast<std::size_t>(v)] = Vector3{};
    is_loaded_[static_cast<std::size_t>(v)] = 0;
  }
  loaded_.clear();
}

Vector3 LoadedSurface::total_force() const {
  Vector3 sum{};
  for (const int v : loaded_)
    sum = sum + contact_load(v);
  return sum;
}

Vector3 LoadedSurface::moment(const Vector3 &about) const {
  Vector3 sum{};
  for (const int v : loaded_)
    sum = sum + cross(surface_.vertices[static_cast<std::size_t>(v)] - about, contact_load(v));
  return sum;
}

std::vector<LoadedSurface::Traction> LoadedSurface::contact_tractions() const {
  const auto areas = tributary_areas(surface_);
  std::vector<Traction> tractions(areas.size());
  for (std::size_t v = 0; v < areas.size(); ++v)
    tractions[v] = traction(areas[v], load_[v]);
  return tractions;
}

void LoadedSurface::describe_loads(Archive &archive) {
  std::vector<int> vertices(loaded_);
  std::vector<Vector3> forces;
  for (const int v : loaded_)
    forces.push_back(contact_load(v));
  archive.rows("loaded_vertices", vertices, "1", row_of(load_.size()));
  archive.rows("loads", forces, "N");
  if (const StateSource *state = archive.looks_at())
    require_as_many(*state, archive.path("loaded_vertices"), archive.path("loads"));
  if (!archive.reads()) return;
  clear_loads();
  for (std::size_t k = 0; k < vertices.size(); ++k)
    add_surface_force(vertices[k], forces[k]);
}

} // namespace platen::fem
