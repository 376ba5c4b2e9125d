// What a file of Gmsh must be for a mesh to be made of it.
#pragma once

#include <string>
#include <string_view>

namespace platen::fem {

// Throws std::invalid_argument, as "NAME:LINE: error: ...", where `text` is no ASCII file of format 2.2
// or 4.1 whose counts hold, whose elements name nodes that are there, and whose hexahedra make a body: eight
// nodes each, a face between two of them at most, every quadrilateral a face and every line an edge of one.
// deal.II reads what is left; of files with such faults it takes some for memory that is not there.
void check_gmsh(std::string_view text, const std::string &name);

} // namespace platen::fem
