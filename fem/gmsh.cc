#include "fem/gmsh.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/shortest_text.h"

namespace platen::fem {
namespace {

constexpr double smallest = 1e-6, largest = 100; // m, allowed size of a platen

[[noreturn]] void refuse(const GmshOptions &options, const std::string &what) {
  throw std::invalid_argument((options.name.empty() ? "Gmsh file" : options.name) + ": " + what);
}

void read(std::istream &stream, const GmshOptions &options, dealii::Triangulation<3> &grid) {
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  check_gmsh(text, options.name.empty() ? "Gmsh file" : options.name);
  std::istringstream checked(text);
  dealii::GridIn<3> reader(grid);
  try {
    reader.read_msh(checked);
  } catch (const dealii::ExceptionBase &failure) {
    std::ostringstream why;
    failure.print_info(why);
    std::string reason = why.str();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    refuse(options, "is no mesh of hexahedra that can be read:" + reason);
  } catch (const std::exception &failure) {
    refuse(options, std::string("is no mesh of hexahedra that can be read: ") + failure.what());
  }
}

void count_materials(dealii::Triangulation<3> &grid) {
  std::map<dealii::types::material_id, dealii::types::material_id> count;
  for (const auto &cell : grid.active_cell_iterators())
    count[cell->material_id()] = 0;
  dealii::types::material_id next = 0;
  for (auto &[id, place] : count)
    place = next++;
  for (const auto &cell : grid.active_cell_iterators())
    cell->set_material_id(count[cell->material_id()]);
}

void tag_ends_if_unnamed(dealii::Triangulation<3> &grid, double low, double high) {
  for (const dealii::types::boundary_id tag : grid.get_boundary_ids())
    if (tag != 0) return;
  const double near = 1e-6 * (high - low);
  for (const auto &face : grid.active_face_iterators()) {
    if (!face->at_boundary()) continue;
    bool at_low = true, at_high = true;
    for (const unsigned int v : face->vertex_indices()) {
      at_low = at_low && face->vertex(v)[2] < low + near;
      at_high = at_high && face->vertex(v)[2] > high - near;
    }
    if (at_low) face->set_boundary_id(low_end_tag);
    if (at_high) face->set_boundary_id(high_end_tag);
  }
}

} // namespace

Grid read_gmsh(std::istream &stream, const GmshOptions &options) {
  if (!(options.unit > 0)) refuse(options, "the unit of length must be positive");
  auto grid = std::make_shared<dealii::Triangulation<3>>();
  read(stream, options, *grid);
  dealii::GridTools::scale(options.unit, *grid);
  const auto [low, high] = dealii::GridTools::compute_bounding_box(*grid).get_boundary_points();
  const double across = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (!(across > smallest && across < largest))
    refuse(options, "the body is " + text_of(across) + " m across; allowed are " + text_of(smallest) +
                        " to " + text_of(largest) + " m. Is " + text_of(options.unit) +
                        " m the file's unit of length?");
  const std::string inverted = inverted_cell(grid);
  if (!inverted.empty()) refuse(options, inverted + " is inverted or warped through itself");
  count_materials(*grid);
  tag_ends_if_unnamed(*grid, low[2], high[2]);
  return grid;
}

} // namespace platen::fem
