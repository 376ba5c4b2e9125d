#include "coupling/boundaries/strips.h"

#include <algorithm>
#include <cmath>

namespace platen::coupling {

fem::Grid make_grid(const Strips &s) {
  std::vector<fem::BoxPlate> boxes;
  for (const double x : s.middles)
    boxes.push_back({{x - 0.5 * s.width, -0.5 * s.length, s.z_low},
                     {x + 0.5 * s.width, 0.5 * s.length, s.z_low + s.thickness},
                     {s.elements_across, s.elements_across, 2}});
  return fem::make_grid(boxes);
}

bool each_meets_a_sphere(const Strips &strips, const dem::Specimen &specimen, double depth) {
  const auto meets = [&](double middle) {
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      const Vector3 &c = specimen.centre[i];
      const double r = specimen.radius[i];
      const double gap =
          strips.presses_from_above ? strips.z_low - c.z - r : c.z - r - strips.z_low - strips.thickness;
      if (gap <= depth && std::abs(c.x - middle) <= 0.5 * strips.width) return true;
    }
    return false;
  };
  return std::all_of(strips.middles.begin(), strips.middles.end(), meets);
}

} // namespace platen::coupling
