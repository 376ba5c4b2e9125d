// Vectors that begin at a cache line, so that a full register of their elements never crosses two lines.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace platen {

constexpr std::size_t cache_line = 64; // bytes

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U> &) {}
  T *allocate(std::size_t n) {
    return static_cast<T *>(::operator new(n * sizeof(T), std::align_val_t(cache_line)));
  }
  void deallocate(T *p, std::size_t) { ::operator delete(p, std::align_val_t(cache_line)); }
};
template <class T, class U>
bool operator==(const AlignedAllocator<T> &, const AlignedAllocator<U> &) {
  return true;
}
template <class T, class U>
bool operator!=(const AlignedAllocator<T> &, const AlignedAllocator<U> &) {
  return false;
}

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

} // namespace platen
