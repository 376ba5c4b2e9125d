// Memory bandwidth of this machine: the triad a = b + s c on arrays that no cache holds.
#pragma once

#include <cstddef>
#include <vector>

namespace platen::bench {

// Bytes per second of each repeat. Counted are 24 bytes an element: two loads and a store. A processor that
// first reads the line it is going to write (write allocate) moves 32.
std::vector<double> triad_bandwidth(int threads, std::size_t elements, int repeats);

} // namespace platen::bench
