// Signals that a run obeys between two steps.
#pragma once

namespace platen::apps {

// From now on SIGINT and SIGTERM ask the run to stop (a second one ends the process at once, with status 128
// + signal), and so does SIGHUP, the end of a terminal, which never ends it at once and stays ignored where
// it was. SIGUSR1 asks for a checkpoint. A file that reaches a limit on its size, and a reader of the output
// that has left, are failed writes instead of the end.
void catch_stop_signals();

// The signal that asked the run to stop, 0 while none did.
int stop_requested();

// Thrown where all that was under way has been brought to rest.
struct Stopped {
  int signal;
};

// 130 for SIGINT, 143 for SIGTERM, 129 for SIGHUP.
inline int exit_status_of_signal(int signal) {
  return 128 + signal;
}

// Whether a checkpoint was asked for since the last call.
bool take_checkpoint_request();

} // namespace platen::apps
