#include "fem/gmsh.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/grid/grid_in.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/shortest_text.h"
#include "fem/triangulation.h"

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

// Material ids from 0, in the order of those in the file.
void count_materials(Hexahedra &grid) {
  std::map<int, int> count;
  for (const int id : grid.material)
    count[id] = 0;
  int next = 0;
  for (auto &[id, place] : count)
    place = next++;
  for (int &id : grid.material)
    id = count[id];
}

void tag_ends_if_unnamed(Hexahedra &grid, double low, double high) {
  for (const BoundaryFace &face : grid.faces)
    if (face.tag != 0) return;
  const double near = 1e-6 * (high - low);
  for (BoundaryFace &face : grid.faces) {
    bool at_low = true, at_high = true;
    for (const int v : face.nodes) {
      at_low = at_low && grid.vertices[static_cast<std::size_t>(v)].z < low + near;
      at_high = at_high && grid.vertices[static_cast<std::size_t>(v)].z > high - near;
    }
    if (at_low) face.tag = low_end_tag;
    if (at_high) face.tag = high_end_tag;
  }
}

} // namespace

Grid read_gmsh(std::istream &stream, const GmshOptions &options) {
  if (!(options.unit > 0)) refuse(options, "the unit of length must be positive");
  dealii::Triangulation<3> known;
  read(stream, options, known);
  Hexahedra grid = hexahedra(known);
  Vector3 low = options.unit * grid.vertices[0], high = low;
  for (Vector3 &v : grid.vertices) {
    v = options.unit * v;
    for (std::size_t k = 0; k < 3; ++k)
      low[k] = std::min(low[k], v[k]), high[k] = std::max(high[k], v[k]);
  }
  const double across = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  if (!(across > smallest && across < largest))
    refuse(options, "the body is " + text_of(across) + " m across; allowed are " + text_of(smallest) +
                        " to " + text_of(largest) + " m. Is " + text_of(options.unit) +
                        " m the file's unit of length?");
  count_materials(grid);
  tag_ends_if_unnamed(grid, low.z, high.z);
  const Grid made = std::make_shared<const Hexahedra>(std::move(grid));
  const std::string inverted = inverted_cell(made);
  if (!inverted.empty()) refuse(options, inverted + " is inverted or warped through itself");
  return made;
}

} // namespace platen::fem
