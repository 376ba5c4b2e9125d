#include "fem/surface_mesh.h"

#include <algorithm>

namespace platen::fem {
namespace {

// A face is called empty below this share of its squared diagonal; needles of aspect 1e-9 still have a
// normal.
constexpr double empty_face = 1e-12;

Vector3 corner(const SurfaceMesh &surface, std::size_t face, std::size_t k) {
  return surface.vertices[static_cast<std::size_t>(surface.faces[face][k])];
}

} // namespace

Vector3 face_area_vector(const SurfaceMesh &surface, std::size_t face) {
  const Vector3 first = corner(surface, face, 2) - corner(surface, face, 0);
  const Vector3 second = corner(surface, face, 3) - corner(surface, face, 1);
  return 0.5 * cross(first, second);
}

Vector3 total_area_vector(const SurfaceMesh &surface) {
  Vector3 sum{};
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    sum = sum + face_area_vector(surface, f);
  return sum;
}

double enclosed_volume(const SurfaceMesh &surface) {
  if (surface.vertices.empty()) return 0;
  const Vector3 origin = surface.vertices[0]; // any point does; a near one loses fewer digits
  double sum = 0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    Vector3 middle{};
    for (std::size_t k = 0; k < 4; ++k)
      middle = middle + 0.25 * (corner(surface, f, k) - origin);
    sum += dot(middle, face_area_vector(surface, f)) / 3.0;
  }
  return sum;
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

} // namespace platen::fem
