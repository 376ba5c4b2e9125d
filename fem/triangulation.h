// Grids as deal.II knows them. Included only by .cc files that use deal.II.
#pragma once

#include <deal.II/grid/tria.h>

#include <memory>

#include "fem/grids.h"

namespace platen::fem {

// Cells and vertices keep their numbers, faces their tags.
std::shared_ptr<const dealii::Triangulation<3>> triangulation(const Hexahedra &grid);
Hexahedra hexahedra(const dealii::Triangulation<3> &grid);

// Threads of deal.II. Loops over cells and nodes use the pool of the process (base/parallel.h) instead.
//
// With one thread, deal.II copies the geometry of a cell from an equal cell before it, which changes the last
// bits. While any object of this class exists, deal.II may have two threads, so that matrices do not depend
// on the program's thread limit; afterwards one, since a process has no second pool.
class NoCellReuse {
public:
  NoCellReuse();
  ~NoCellReuse();
  NoCellReuse(const NoCellReuse &) = delete;
  NoCellReuse &operator=(const NoCellReuse &) = delete;
};

} // namespace platen::fem
