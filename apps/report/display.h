// Debian's VTK draws only with an X server, and ends the process where there is none.
#pragma once

namespace platen::apps::report {

// Returns where a display can be drawn on. Else replaces this process by itself under `xvfb-run`, with the
// same arguments; does not return then. Throws InputError where that is not possible either: what to install
// is said.
void ensure_display(char **argv);

} // namespace platen::apps::report
