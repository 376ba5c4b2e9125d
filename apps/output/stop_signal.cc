#include "apps/output/stop_signal.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace platen::apps {
namespace {

std::atomic<int> stop{0};
std::atomic<bool> checkpoint{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler must not wait for a lock");

extern "C" void on_stop(int number) {
  int before = 0;
  if (stop.compare_exchange_strong(before, number)) return;
  if (before != SIGHUP || !stop.compare_exchange_strong(before, number))
    ::_exit(exit_status_of_signal(number));
}

// A terminal that closes says so more than once, and a system that ends a session says SIGTERM as well.
extern "C" void on_hang_up(int number) {
  int none = 0;
  stop.compare_exchange_strong(none, number);
}

extern "C" void on_checkpoint(int) {
  checkpoint = true;
}

void install(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART; // system calls of the run and its libraries go on
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

bool is_ignored(int number) {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

} // namespace

void catch_stop_signals() {
  stop = 0;
  checkpoint = false;
  install(SIGINT, on_stop);
  install(SIGTERM, on_stop);
  if (!is_ignored(SIGHUP)) install(SIGHUP, on_hang_up); // as nohup leaves it
  install(SIGUSR1, on_checkpoint);
  sigset_t held; // until now by run_app, so that one that came earlier is not lost
  sigemptyset(&held);
  sigaddset(&held, SIGUSR1);
  pthread_sigmask(SIG_UNBLOCK, &held, nullptr);
  install(SIGXFSZ, SIG_IGN);
  install(SIGPIPE, SIG_IGN);
}

int stop_requested() {
  return stop;
}

bool take_checkpoint_request() {
  return checkpoint.exchange(false);
}

} // namespace platen::apps
