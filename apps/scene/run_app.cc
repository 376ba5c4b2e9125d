#include <signal.h>
#include <unistd.h>

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "apps/scene/command_line.h"
#include "apps/scene/parameters.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

// The message of deal.II's exceptions stands in the middle of a page about file, function and stack.
std::string plain(const std::string &what) {
  const std::string begin = "Additional information:";
  const auto found = what.find(begin);
  if (found == std::string::npos) return what;
  std::string text = what.substr(found + begin.size());
  for (const char *after : {"Stacktrace:", "--------"})
    text = text.substr(0, text.find(after));
  const auto first = text.find_first_not_of(" \n"), last = text.find_last_not_of(" \n");
  return first == std::string::npos ? what : text.substr(first, last - first + 1);
}

// Names of files in a message may hold what a terminal obeys; line ends are the message's own.
std::string printable(std::string text) {
  for (char &c : text)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f) c = '?';
  return text;
}

int report(const std::string &message, int status) {
  before_reporting_a_failure();
  std::cout.flush();
  std::cerr << printable(plain(message)) << '\n';
  after_reporting_a_failure(status);
  return status;
}

// The command line without its number of threads, which may be another on each machine.
std::string words_but_threads(int argc, const char *const *argv, const Program &program) {
  std::string words = program.name;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "-t" || word == "--threads")
      ++k;
    else if (word.rfind("-t", 0) != 0 && word.rfind("--threads=", 0) != 0)
      words += '\0' + word;
  }
  return words;
}

void require_ranks(int argc, const char *const *argv, const Program &program, RequireSame require_same) {
  if (require_same != nullptr) return require_same(words_but_threads(argc, argv, program));
  try {
    require_one_process(program.name);
  } catch (const InputError &error) {
    throw InputError(std::string("error: ") + error.what());
  }
}

extern "C" void end_at_once(int number) {
  ::_exit(128 + number);
}

int run(const CommandLine &line, const Program &program, const AppBody &body) {
  const Scene scene =
      line.scene.empty() ? default_scene(program) : read_scene(line.scene, line.overrides, program);
  if (line.print_parameters) {
    if (this_rank().is_silent()) return status_done;
    print_parameters(scene, line.part, line.json, std::cout);
    return status_done;
  }
  try {
    return body(line, scene);
  } catch (const BadParameter &error) { // of the library, which knows no file
    scene.parameters->refuse(error);
  } catch (const coupling::BadSetup &error) {
    refuse(scene, scene.parameters->entry_of(error.member()), scene.parameters->with_entries(error.reason()));
  }
}

// What `act` returns, or the status of what it throws, which is reported.
int with_status(const std::function<int()> &act) {
  try {
    return act();
  } catch (const PrintAndExit &asked) {
    if (!this_rank().is_silent()) std::cout << asked.text;
    return status_done;
  } catch (const InputError &error) {
    return report(error.what(), status_bad_input);
  } catch (const OutputError &error) {
    return report(std::string("error: ") + error.what(), status_output);
  } catch (const std::filesystem::filesystem_error &error) {
    return report(std::string("error: ") + error.what(), status_output);
  } catch (const std::invalid_argument &error) {
    return report(std::string("error: ") + error.what(), status_bad_input);
  } catch (const std::bad_alloc &) {
    return report("error: the memory is used up; a smaller specimen or larger spheres need less",
                  status_numerics);
  } catch (const std::exception &error) {
    return report(std::string("error: ") + error.what(), status_numerics);
  }
}

} // namespace

void obey_early_signals() {
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action.sa_handler = end_at_once;
    sigaction(number, &action, nullptr);
  }
  sigset_t waits;
  sigemptyset(&waits);
  sigaddset(&waits, SIGUSR1);
  sigprocmask(SIG_BLOCK, &waits, nullptr);
}

int run_app(int argc, char **argv, const Program &program, const AppBody &body, RequireSame require_same) {
  obey_early_signals();
  return with_status([&] {
    require_ranks(argc, argv, program, require_same);
    return run(read_command_line(argc, argv, program), program,
               [&](const CommandLine &line, const Scene &scene) {
                 if (!line.quiet && !this_rank().is_silent())
                   for (const std::string &note : scene.notes)
                     std::cerr << note << '\n';
                 return body(line, scene);
               });
  });
}

} // namespace platen::apps
