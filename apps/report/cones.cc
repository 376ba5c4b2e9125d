#include "apps/report/cones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace platen::apps::report {
namespace {

// Whether three numbers stand there.
bool read_vector(const Json &from, const char *key, Position &to) {
  const auto found = from.find(key);
  const auto is_number = [](const Json &one) { return one.is_number(); };
  if (found == from.end() || !found->is_array() || found->size() != 3 ||
      !std::all_of(found->begin(), found->end(), is_number))
    return false;
  to = found->get<Position>();
  return true;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool is_within(const FittedCone &cone, const Position &place) {
  const double wx = place[0] - cone.apex[0], wy = place[1] - cone.apex[1], wz = place[2] - cone.apex[2];
  const double along = wx * cone.axis[0] + wy * cone.axis[1] + wz * cone.axis[2];
  return along > std::cos(cone.half_angle) * std::hypot(wx, wy, wz);
}

} // namespace

FittedCone cone_of(const Run &run, Side end, ConeTime time) {
  FittedCone cone;
  const std::string start = time == ConeTime::end ? "final_" : "",
                    key = end == Side::top ? "cone_top" : "cone_bottom";
  const auto found = run.summary.find(start + key);
  const auto pattern = run.summary.find(start + "pattern"); // null where nobody looked
  if (found == run.summary.end() || pattern == run.summary.end() || pattern->is_null()) return cone;
  if (const auto zone = run.summary.find(start + "dead_zone" + key.substr(4));
      zone == run.summary.end() || zone->is_null())
    return cone; // the stress did not fall
  if (found->is_null()) {
    cone.verdict = FittedCone::Verdict::none;
    return cone;
  }
  if (!read_vector(*found, "apex_m", cone.apex) || !read_vector(*found, "axis", cone.axis)) return cone;
  cone.half_angle = found->value("half_angle_deg", 0.0) * degree;
  cone.confidence = found->value("confidence", 0.0);
  cone.verdict = FittedCone::Verdict::found;
  return cone;
}

double angle_of_axes(const std::vector<FittedCone> &cones, double height) {
  const double reach = height / 3; // of an axis: where cones end
  double xx = 0, yy = 0, xy = 0;
  for (const FittedCone &cone : cones) {
    if (cone.verdict != FittedCone::Verdict::found) continue;
    for (const auto &[x, y] :
         {std::pair{cone.apex[0], cone.apex[1]}, std::pair{reach * cone.axis[0], reach * cone.axis[1]}})
      xx += x * x, yy += y * y, xy += x * y;
  }
  return 0.5 * std::atan2(2 * xy, xx - yy);
}

Position turned(const Position &place, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * place[0] + s * place[1], c * place[1] - s * place[0], place[2]};
}

FittedCone turned(FittedCone cone, double angle) {
  cone.apex = turned(cone.apex, angle);
  cone.axis = turned(cone.axis, angle);
  return cone;
}

std::vector<std::array<double, 2>> section_of(const FittedCone &cone, Side end, const Extent &extent) {
  constexpr int levels = 120;
  const double base = end == Side::top ? extent.top : extent.bottom;
  const double cosine = std::cos(cone.half_angle), squared = cosine * cosine;
  // On the plane, at height z, (w . axis)^2 = cos^2 w^2 with w from the apex is quadratic in w_x.
  const double a = squared - cone.axis[0] * cone.axis[0];
  std::vector<std::array<double, 2>> up, down;
  if (a <= 0) return up; // leans by more than it opens: no closed section
  for (int k = 0; k <= levels; ++k) {
    const double z = base + (cone.apex[2] - base) * k / levels;
    const double wy = -cone.apex[1], wz = z - cone.apex[2];
    const double along = wy * cone.axis[1] + wz * cone.axis[2];
    const double half_b = cone.axis[0] * along;
    const double root = half_b * half_b + a * (along * along - squared * (wy * wy + wz * wz));
    if (root < 0) break; // above the section's tip
    const auto at = [&](double sign) {
      const double x = cone.apex[0] + (half_b + sign * std::sqrt(root)) / a;
      return std::array<double, 2>{std::clamp(x, -extent.half_width, extent.half_width), z};
    };
    up.push_back(at(-1));
    down.push_back(at(1));
  }
  up.insert(up.end(), down.rbegin(), down.rend());
  return up;
}

Position carried(const FittedCone &cone, const Spheres &spheres) {
  std::array<std::vector<double>, 3> displacement;
  for (std::size_t k = 0; k < spheres.size(); ++k)
    if (is_within(cone, spheres.initial[k]))
      for (std::size_t d = 0; d < 3; ++d)
        displacement[d].push_back(spheres.position[k][d] - spheres.initial[k][d]);
  return {median(displacement[0]), median(displacement[1]), median(displacement[2])};
}

std::string words_of(const FittedCone &cone) {
  if (cone.verdict == FittedCone::Verdict::not_measured) return "not measured";
  if (cone.verdict == FittedCone::Verdict::none) return "no cone";
  return fmt::format("{:.0f} degrees (confidence {:.2f})", cone.half_angle / degree, cone.confidence);
}

} // namespace platen::apps::report
