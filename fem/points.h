// Eight numbers, one for each Gauss point, that are processed as one vector. For .cc files.
#pragma once

#include <cstring>

#include "fem/materials/logarithmic_strain.h"

namespace platen::fem {

typedef double Points __attribute__((vector_size(64)));

PLATEN_INTO_CALLER void read(const double *from, Points &to) {
  std::memcpy(&to, from, sizeof to);
}

} // namespace platen::fem
