// A loop as a value.
#pragma once

#include <cstddef>

namespace platen {

// Parts that may run in any order and at the same time.
struct Loop {
  std::size_t parts = 0;
  void (*call)(const void *body, std::size_t part) = nullptr;
  const void *body = nullptr; // type-erased; must outlive the call
};

// The loop part(p) for p in [0, parts); `part` must outlive it.
template <class Part>
Loop loop_of(std::size_t parts, const Part &part) {
  return {parts, [](const void *body, std::size_t p) { (*static_cast<const Part *>(body))(p); }, &part};
}

} // namespace platen
