#include "coupling/boundaries/mean_loads.h"

#include <array>
#include <stdexcept>
#include <string>

namespace platen::coupling {

void MeanLoads::add(const fem::Body &body, double dt) {
  for (const int v : body.loaded_vertices())
    impulse_[static_cast<std::size_t>(v)] = impulse_[static_cast<std::size_t>(v)] + dt * body.contact_load(v);
  time_ += dt;
  ++steps_;
}

std::vector<Vector3> MeanLoads::mean() const {
  std::vector<Vector3> loads(impulse_);
  for (Vector3 &load : loads)
    load = (1 / time_) * load;
  return loads;
}

void MeanLoads::reset() {
  impulse_.assign(impulse_.size(), Vector3{});
  time_ = 0;
  steps_ = 0;
}

void MeanLoads::describe(Archive &archive) {
  archive.version(1);
  archive("time", time_, "s");
  archive("steps", steps_);
  archive.same_rows("impulse", impulse_, "N s");
}

namespace {

// A face is asked at the middles of this many parts along each side.
constexpr int parts = 8;

} // namespace

MeanPlace::MeanPlace(const fem::SurfaceMesh &surface, int tag,
                     const std::function<bool(double, double)> &covers) {
  std::vector<double> part(surface.vertices.size(), 0.0), whole(part);
  double covered = 0, all = 0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (surface.face_tags[f] != tag) continue;
    const std::array<int, 4> &corners = surface.faces[f];
    const double area = norm(fem::face_area_vector(surface, f)) / (parts * parts);
    for (int k = 0; k < parts * parts; ++k) {
      const double s = (k % parts + 0.5) / parts, t = (k / parts + 0.5) / parts;
      const std::array<double, 4> weights = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
      Vector3 place{};
      for (std::size_t c = 0; c < 4; ++c)
        place = place + weights[c] * surface.vertices[static_cast<std::size_t>(corners[c])];
      const bool inside = covers(place[0], place[1]);
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t v = static_cast<std::size_t>(corners[c]);
        whole[v] += weights[c] * area;
        if (inside) part[v] += weights[c] * area;
      }
      all += area;
      if (inside) covered += area;
    }
  }
  if (!(all > 0)) throw std::invalid_argument("mean place: no face has the tag " + std::to_string(tag));
  const std::vector<double> &area = covered > 0 ? part : whole;
  for (std::size_t v = 0; v < area.size(); ++v) {
    if (area[v] == 0) continue;
    vertices_.push_back(static_cast<int>(v));
    shares_.push_back(area[v] / (covered > 0 ? covered : all));
  }
  start_ = height(surface);
}

double MeanPlace::height(const fem::SurfaceMesh &surface) const {
  double z = 0;
  for (std::size_t k = 0; k < vertices_.size(); ++k)
    z += shares_[k] * surface.vertices[static_cast<std::size_t>(vertices_[k])][2];
  return z;
}

} // namespace platen::coupling
