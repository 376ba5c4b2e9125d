#include "dem/packing/ends.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace platen::dem {

SpecimenEnds seat_ends(const Specimen &specimen, EndPreparation preparation, double end_layer) {
  if (!(end_layer >= 0) || !std::isfinite(end_layer))
    throw std::invalid_argument(
        "the end layer of a specimen must be finite and not negative (in mean radii)");
  SpecimenEnds ends;
  if (preparation == EndPreparation::as_packed) return ends;
  const double layer = end_layer * mean_radius(specimen);
  const auto seat = [&](EndSeats &end, std::size_t i, double gap) {
    if (gap > layer) return;
    end.particle.push_back(static_cast<int>(i));
    end.offset.push_back(gap);
  };
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double z = specimen.centre[i].z, r = specimen.radius[i];
    seat(ends.bottom, i, z - r);
    seat(ends.top, i, specimen.shape.height - z - r);
  }
  return ends;
}

} // namespace platen::dem
