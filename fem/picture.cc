#include "fem/picture.h"

#include <stdexcept>

namespace platen::fem {

Picture picture_of(const std::string &who, const LoadedSurface &body, const std::vector<int> &node,
                   const std::vector<double> &slip, const std::vector<Vector3> &reference,
                   const std::vector<Vector3> &displacement, const std::vector<std::array<int, 8>> &cells) {
  if (!slip.empty() && slip.size() != node.size())
    throw std::invalid_argument(who + ": slip must have one value per surface vertex");
  std::vector<double> pressures(reference.size()), slips(reference.size()); // Pa, m
  std::vector<Vector3> shears(reference.size());                            // Pa
  const std::vector<LoadedSurface::Traction> tractions = body.contact_tractions();
  for (std::size_t v = 0; v < node.size(); ++v) {
    const auto n = static_cast<std::size_t>(node[v]);
    pressures[n] = tractions[v].pressure;
    shears[n] = tractions[v].shear;
    if (!slip.empty()) slips[n] = slip[v];
  }
  Picture picture;
  for (std::size_t n = 0; n < reference.size(); ++n)
    picture.points.push_back(reference[n] + displacement[n]);
  for (const std::array<int, 8> &cell : cells)
    for (const std::size_t corner : {0, 1, 3, 2, 4, 5, 7, 6})
      picture.cells.push_back(cell[corner]);
  picture.of_points = {picture_field("displacement", displacement, 3),
                       picture_field("contact_shear", shears, 3),
                       {"contact_pressure", 1, std::move(pressures)},
                       {"slip", 1, std::move(slips)}};
  return picture;
}

} // namespace platen::fem
