// Which rows of contacts have something to do in a step: most pairs that are near do not touch. One source,
// compiled once per instruction set (contact_kernel.inc.h), to the same rows.
#pragma once

#include <cstddef>

#include "base/vector3.h"

namespace platen::dem::kernels {

struct ContactColumns {
  const int *first, *second;   // of each row
  const double *rest_distance; // m
  const int *touching;
  const Vector3 *position; // of each particle, with one row to spare
};

// Of rows [first, last): those that are closer than their rest distance, or were touching, ascending. Writes
// them to `rows`, which has room for all; returns their number. What is not a number counts as close, so that
// it shows in the forces.
using ContactKernel = std::size_t (*)(const ContactColumns &, std::size_t first, std::size_t last, int *rows);
std::size_t rows_at_work_baseline(const ContactColumns &, std::size_t first, std::size_t last, int *rows);
std::size_t rows_at_work_avx2(const ContactColumns &, std::size_t first, std::size_t last, int *rows);
std::size_t rows_at_work_avx512(const ContactColumns &, std::size_t first, std::size_t last, int *rows);

} // namespace platen::dem::kernels
