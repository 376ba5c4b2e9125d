#pragma once

namespace platen::fem {

// Called before the first use of bodies that deform and of grids from files. Nothing to do where these are
// linked; a program may define this function to load a library with them only then, because deal.II and the
// libraries that it needs take .4 s to load. Throws std::runtime_error where it is not there.
void load_solids();

} // namespace platen::fem
