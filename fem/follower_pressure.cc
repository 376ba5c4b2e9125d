#include "fem/follower_pressure.h"

#include <cmath>
#include <cstddef>

namespace platen::fem {
namespace {

constexpr std::array<double, 4> s_of = {-1, 1, 1, -1}, t_of = {-1, -1, 1, 1};

struct Bilinear {
  Vector3 a{}, b{}, c{};
  explicit Bilinear(const FaceCorners &x)
      : a(0.25 * ((x[1] + x[2]) - (x[0] + x[3]))),
        b(0.25 * ((x[2] + x[3]) - (x[0] + x[1]))),
        c(0.25 * ((x[0] + x[2]) - (x[1] + x[3]))) {}
};

} // namespace

FaceCorners corner_areas(const FaceCorners &place) {
  const Bilinear face(place);
  const Vector3 middle = cross(face.a, face.b), along = (1.0 / 3) * cross(face.a, face.c),
                across = (1.0 / 3) * cross(face.c, face.b);
  FaceCorners areas;
  for (std::size_t k = 0; k < 4; ++k)
    areas[k] = middle + s_of[k] * along + t_of[k] * across;
  return areas;
}

double swept_volume(const FaceCorners &from, const FaceCorners &to) {
  const double off = 0.5 / std::sqrt(3.0);
  double volume = 0;
  for (const double share : {0.5 - off, 0.5 + off}) {
    FaceCorners place;
    for (std::size_t k = 0; k < 4; ++k)
      place[k] = (1 - share) * from[k] + share * to[k];
    const FaceCorners areas = corner_areas(place);
    for (std::size_t k = 0; k < 4; ++k)
      volume += 0.5 * dot(areas[k], to[k] - from[k]);
  }
  return volume;
}

std::array<double, 144> corner_area_gradient(const FaceCorners &place) {
  const Bilinear face(place);
  std::array<double, 144> gradient;
  for (std::size_t m = 0; m < 4; ++m)
    for (std::size_t n = 0; n < 4; ++n) {
      const double s = s_of[n], t = t_of[n], st = s * t, third_s = s_of[m] / 3, third_t = t_of[m] / 3;
      // The change of n_m under a move d of corner n is d x w.
      const Vector3 w = 0.25 * ((s * face.b - t * face.a) + third_s * (s * face.c - st * face.a) +
                                third_t * (st * face.b - t * face.c));
      const std::array<double, 9> block = {0, w[2], -w[1], -w[2], 0, w[0], w[1], -w[0], 0};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          gradient[12 * (3 * m + i) + 3 * n + k] = block[3 * i + k];
    }
  return gradient;
}

} // namespace platen::fem
