// Transfer of the history of cohesive bonds between columns and SIMD vectors.
#pragma once

#include <type_traits>

#include "dem/kernels/cohesive_kernel.h"
#include "dem/kernels/simd.inc.h"

namespace platen::dem::kernels {
namespace {

// History of the last cohesive bonds of a block; the last bond is repeated if they do not fill a SIMD vector.
struct MemoryTail {
  double scalar[most_scalars][lanes];
  Vector3 vector[most_vectors][lanes + 1];

  MemoryTail(const MemoryColumns &c, std::size_t from, std::size_t to) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t k = from + l < to ? from + l : to - 1;
      for (std::size_t m = 0; m < most_scalars && c.scalar[m] != nullptr; ++m)
        scalar[m][l] = c.scalar[m][k];
      for (std::size_t m = 0; m < most_vectors && c.vector[m] != nullptr; ++m)
        vector[m][l] = c.vector[m][k];
    }
  }
  MemoryColumns columns() {
    MemoryColumns c;
    for (std::size_t m = 0; m < most_scalars; ++m)
      c.scalar[m] = scalar[m];
    for (std::size_t m = 0; m < most_vectors; ++m)
      c.vector[m] = vector[m];
    return c;
  }
  void give_back(const MemoryColumns &c, std::size_t from, std::size_t to) const {
    for (std::size_t l = 0; from + l < to; ++l) {
      for (std::size_t m = 0; m < most_scalars && c.scalar[m] != nullptr; ++m)
        c.scalar[m][from + l] = scalar[m][l];
      for (std::size_t m = 0; m < most_vectors && c.vector[m] != nullptr; ++m)
        c.vector[m][from + l] = vector[m][l];
    }
  }
};

PLATEN_INLINE void store(double *to, const Simd &a) {
  for (int l = 0; l < lanes; ++l)
    to[l] = a.v[l];
}

// Calls f(address, member) for every member of a state, with the address of row k in its column.
template <class State, class F>
PLATEN_INLINE void for_each_memory(const MemoryColumns &columns, std::size_t k, State &state, const F &f) {
  std::size_t scalars = 0, vectors = 0;
  State::describe(
      [&](const char *, const char *, auto &member) {
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Simd>)
          f(columns.scalar[scalars++] + k, member);
        else
          f(columns.vector[vectors++] + k, member);
      },
      state);
}

// Stores the members of a state that the quick path of a law changes.
template <class Law, class State>
PLATEN_INLINE void keep_intact(const MemoryColumns &columns, std::size_t k, State &state, bool yielded) {
  std::size_t scalars = 0, vectors = 0, member_at = 0;
  State::describe(
      [&](const char *, const char *, auto &member) {
        const Changes how = Law::intact_members[member_at++];
        const bool changes = how == Changes::always || (how == Changes::rarely && yielded);
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Simd>) {
          double *column = columns.scalar[scalars++];
          if (changes) store(column + k, member);
        } else {
          Vector3 *column = columns.vector[vectors++];
          if (changes) store(column + k, member);
        }
      },
      state);
}

} // namespace
} // namespace platen::dem::kernels
