// Bodies of the kernels of soft spheres; the including file sets PLATEN_LANES and the names. Compiled without
// contraction: every instruction set gives the same columns. (Sums over lanes do not: who reads them allows
// for their round-off.)
#include "dem/kernels/pack.inc.h"
#include "dem/kernels/soft_kernel.h"

namespace platen::dem::kernels {
namespace {

constexpr double tiny = 1e-300; // keeps the direction of two coincident spheres finite (zero)

inline Rotation<Pack> load_balls(const Ball *from) { // w: radii
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&from[l].radius);
  return to_columns(rows);
}
inline Rotation<Pack> gather_balls(const Ball *ball, const int *at) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&ball[at[l]].radius);
  return to_columns(rows);
}

inline Triple<Pack> where_equal(const Pack &a, const Pack &b, const Triple<Pack> &then,
                                const Triple<Pack> &otherwise) {
  return {a.v == b.v ? then.x.v : otherwise.x.v, a.v == b.v ? then.y.v : otherwise.y.v,
          a.v == b.v ? then.z.v : otherwise.z.v};
}

inline double sum_of(const Pack &a) {
  double sum = 0;
  for (int l = 0; l < lanes; ++l)
    sum += a.v[l];
  return sum;
}
inline double largest_of(const Pack &a) {
  double largest = a.v[0];
  for (int l = 1; l < lanes; ++l)
    largest = a.v[l] > largest ? a.v[l] : largest;
  return largest;
}

struct Sums {
  Pack overlap, largest, number;
};

// Spheres row ... row + lanes of a pack. Forces of earlier partners are added to the load itself, those of
// later ones apart: the order in which a loop over pairs adds them.
inline void add_forces(const SoftColumns &c, std::size_t row, const int *partner, std::size_t steps,
                       Sums &sums) {
  const Rotation<Pack> own = load_balls(c.ball + row);
  const Pack earlier = load(c.earlier + row);
  Triple<Pack> load_of_earlier{}, load_now{};
  if (c.press) load_now = load(c.press + row);
  const Triple<Pack> none{};
  for (std::size_t k = 0; k < steps; ++k, partner += soft_pack) {
    const Pack at = static_cast<double>(k);
    load_of_earlier = where_equal(earlier, at, load_now, load_of_earlier);
    load_now = where_equal(earlier, at, none, load_now);
    const Rotation<Pack> other = gather_balls(c.ball, partner);
    const Triple<Pack> d{other.x - own.x, other.y - own.y, other.z - own.z};
    const Pack distance = root(dot(d, d));
    const Pack overlap = positive_part(own.w + other.w - distance);
    const Pack weight = overlap / (distance + tiny);
    load_now = load_now - scale(weight, d);
    const Pack counted = earlier.v <= at.v ? overlap.v : Native{};
    sums.overlap = sums.overlap + counted;
    sums.largest = larger(sums.largest, counted);
    sums.number = sums.number + Pack(counted.v > 0.0 ? 1.0 - Native{} : Native{});
  }
  const Pack at = static_cast<double>(steps);
  load_of_earlier = where_equal(earlier, at, load_now, load_of_earlier);
  load_now = where_equal(earlier, at, none, load_now);
  store(c.force + row, load_of_earlier + load_now);
}

} // namespace

SoftContacts PLATEN_SOFT_FORCES(SoftColumns c, std::size_t first_pack, std::size_t last_pack) {
  Sums sums;
  for (std::size_t p = first_pack; p < last_pack; ++p) {
    const std::size_t steps = (c.first[p + 1] - c.first[p]) / soft_pack;
    for (std::size_t l = 0; l < soft_pack; l += lanes)
      add_forces(c, soft_pack * p + l, c.partner + c.first[p] + l, steps, sums);
  }
  return {sum_of(sums.overlap), largest_of(sums.largest), sum_of(sums.number)};
}

SoftPower PLATEN_SOFT_SQUARES(SoftColumns c, double step, std::size_t first_pack, std::size_t last_pack) {
  Pack sum, size;
  for (std::size_t row = soft_pack * first_pack; row < soft_pack * last_pack; row += lanes) {
    const Triple<Pack> f = load(c.force + row), v = load(c.velocity + row);
    const Triple<Pack> kicked = v + scale(Pack(step), f);
    const Pack power = dot(f, v), f2 = dot(f, f), v2 = dot(kicked, kicked);
    for (int l = 0; l < lanes; ++l)
      c.force_square[row + static_cast<std::size_t>(l)] = f2.v[l],
                           c.speed_square[row + static_cast<std::size_t>(l)] = v2.v[l];
    sum = sum + power;
    size = size + magnitude(f.x * v.x) + magnitude(f.y * v.y) + magnitude(f.z * v.z);
  }
  return {sum_of(sum), sum_of(size)};
}

double PLATEN_SOFT_DRIFT(SoftColumns c, SoftMove m, std::size_t first_pack, std::size_t last_pack) {
  Pack fastest;
  for (std::size_t row = soft_pack * first_pack; row < soft_pack * last_pack; row += lanes) {
    const Triple<Pack> f = load(c.force + row);
    const Triple<Pack> kicked = load(c.velocity + row) + scale(Pack(m.step), f);
    const Triple<Pack> v = scale(Pack(1 - m.mixing), kicked) + scale(Pack(m.along), f);
    Rotation<Pack> ball = load_balls(c.ball + row);
    ball.x = ball.x + m.step * v.x, ball.y = ball.y + m.step * v.y, ball.z = ball.z + m.step * v.z;
    store(c.velocity + row, v);
    store(reinterpret_cast<Quaternion *>(c.ball + row), ball); // four doubles each
    fastest = larger(dot(v, v), fastest);
  }
  return largest_of(fastest);
}

} // namespace platen::dem::kernels
