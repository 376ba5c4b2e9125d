// Threads of the finite elements' library.
#pragma once

namespace platen::fem {

// Loops over cells use at most `threads` threads from now on; 0: all that the process may have.
void limit_threads(int threads);

} // namespace platen::fem
