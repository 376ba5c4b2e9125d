// A loop as a value.
#pragma once

#include <cstddef>

namespace platen {

// Parts that may be done in any order and at once.
struct Loop {
  std::size_t parts = 0;
  void (*call)(const void *body, std::size_t part) = nullptr;
  const void *body = nullptr; // without its type; outlives the call
};

// The loop part(p) for p of [0, parts); `part` outlives it.
template <class Part>
Loop loop_of(std::size_t parts, const Part &part) {
  return {parts, [](const void *body, std::size_t p) { (*static_cast<const Part *>(body))(p); }, &part};
}

} // namespace platen
