// Preloaded into a program, ends it where its own code does an invalid floating-point operation, divides by
// zero or overflows. What libraries do is let pass: traps are then off in that thread until, a millisecond
// of computing later or so, it is found in code of the program again. traps.py preloads it.
#include <execinfo.h>
#include <link.h>
#include <sys/time.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <csignal>

namespace {

constexpr int status_of_trap = 99;
// Bits of MXCSR that mask invalid operations, divisions by zero and overflows; its low six tell what was.
constexpr unsigned masks = 0x80 | 0x200 | 0x400, told = 0x3f;

struct Range {
  unsigned long long from = ~0ull, to = 0;
};
Range program; // addresses of the program itself: handlers must not ask the loader, which may hold a lock

int find_program(dl_phdr_info *info, std::size_t, void *) {
  for (int k = 0; k < info->dlpi_phnum; ++k)
    if (info->dlpi_phdr[k].p_type == PT_LOAD) {
      const unsigned long long from = info->dlpi_addr + info->dlpi_phdr[k].p_vaddr;
      program.from = std::min(program.from, from);
      program.to = std::max(program.to, from + info->dlpi_phdr[k].p_memsz);
    }
  return 1; // the first is the program
}

bool in_program(const ucontext_t &context) {
  const auto at = static_cast<unsigned long long>(context.uc_mcontext.gregs[REG_RIP]);
  return at >= program.from && at < program.to;
}

void on_trap(int, siginfo_t *, void *where) {
  auto &context = *static_cast<ucontext_t *>(where);
  if (!in_program(context)) {
    context.uc_mcontext.fpregs->mxcsr = (context.uc_mcontext.fpregs->mxcsr | masks) & ~told;
    context.uc_mcontext.fpregs->cwd |= 0x3f;
    return;
  }
  void *frames[16];
  backtrace_symbols_fd(frames, backtrace(frames, 16), STDERR_FILENO);
  _exit(status_of_trap);
}

void on_time(int, siginfo_t *, void *where) {
  auto &context = *static_cast<ucontext_t *>(where);
  if (in_program(context)) context.uc_mcontext.fpregs->mxcsr &= ~(masks | told);
}

[[gnu::constructor]] void set_traps() {
  dl_iterate_phdr(find_program, nullptr);
  struct sigaction action {};
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  action.sa_sigaction = on_trap;
  sigaction(SIGFPE, &action, nullptr);
  action.sa_sigaction = on_time;
  sigaction(SIGPROF, &action, nullptr);
  const itimerval often{{0, 1000}, {0, 1000}};
  setitimer(ITIMER_PROF, &often, nullptr);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}

} // namespace
