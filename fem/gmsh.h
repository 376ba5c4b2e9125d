// Grids made by Gmsh.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "fem/grids.h"

namespace platen::fem {

struct GmshOptions {
  double unit = 1;  // m per unit of length of the file, positive
  std::string name; // of the file, for messages
};

// Reads a mesh of hexahedra (format 2.2 or 4.1, ASCII, first order). Physical volumes become material ids,
// counted from 0 in the order of their numbers; physical surfaces keep their numbers as tags. Where the file
// names no surfaces, faces whose corners all lie at the lowest or highest z get low_end_tag or high_end_tag.
// Throws std::invalid_argument with the file's name where it is not such a mesh (with the line: check_gmsh),
// a cell is inverted or warped through itself (with its position), or the size is not that of a platen.
Grid read_gmsh(std::istream &stream, const GmshOptions &options);

// Throws std::invalid_argument, as "NAME:LINE: error: ...", where `text` is not an ASCII file of format 2.2
// or 4.1 with correct counts, elements of existing nodes, and hexahedra that form a body: eight nodes each,
// at most two at a face, every quadrilateral a face and every line an edge of one. deal.II reads the accepted
// text; some of these faults would make it access invalid memory.
void check_gmsh(std::string_view text, const std::string &name);

} // namespace platen::fem
