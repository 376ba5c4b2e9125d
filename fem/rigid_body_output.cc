// The picture of a body: its grid with what the particles do to it.
#include <deal.II/grid/tria.h>

#include <ostream>
#include <stdexcept>

#include "fem/grid_picture.h"
#include "fem/rigid_body.h"

namespace platen::fem {

void RigidBody::write_vtu(std::ostream &stream, const std::vector<double> &slip) const {
  if (!slip.empty() && slip.size() != load_.size())
    throw std::invalid_argument("body: slip must have one value per surface vertex");
  const std::vector<dealii::Point<3>> &places = grid_->get_vertices();
  VertexField displacement{"displacement", 3, std::vector<double>(3 * places.size())};
  VertexField shear{"contact_shear", 3, std::vector<double>(3 * places.size())};
  VertexField pressure{"contact_pressure", 1, std::vector<double>(places.size())};
  VertexField slipped{"slip", 1, std::vector<double>(places.size())};
  for (std::size_t n = 0; n < places.size(); ++n) {
    const Vector3 reference = {places[n][0], places[n][1], places[n][2]},
                  moved = current_position(reference) - reference;
    for (std::size_t k = 0; k < 3; ++k)
      displacement.values[3 * n + k] = moved[k];
  }
  const std::vector<Traction> tractions = contact_tractions();
  for (std::size_t v = 0; v < grid_vertex_.size(); ++v) {
    const std::size_t n = static_cast<std::size_t>(grid_vertex_[v]);
    for (std::size_t k = 0; k < 3; ++k)
      shear.values[3 * n + k] = tractions[v].shear[k];
    pressure.values[n] = tractions[v].pressure;
    if (!slip.empty()) slipped.values[n] = slip[v];
  }
  write_picture(stream, grid_, {displacement, shear, pressure, slipped});
}

} // namespace platen::fem
