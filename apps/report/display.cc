#include "apps/report/display.h"

#include <X11/Xlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

// Set for the process under xvfb-run, so that a display which fails there too does not start a third.
constexpr const char *under_xvfb = "PLATEN_REPORT_UNDER_XVFB";

// The connection is kept until the process ends: an X server starts anew when its last client leaves, and
// refuses those who come at that moment.
bool display_is_usable() {
  static Display *const display = XOpenDisplay(nullptr); // null: what DISPLAY names
  return display != nullptr;
}

bool is_on_path(const std::string &program) {
  const char *path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

} // namespace

void ensure_display(char **argv) {
  if (display_is_usable()) return;
  if (std::getenv(under_xvfb) != nullptr)
    throw InputError("the display that xvfb-run gave cannot be used; pictures need an X server");
  for (const char *program : {"xvfb-run", "Xvfb", "xauth"})
    if (!is_on_path(program))
      throw InputError(std::string("there is no display to draw on and no ") + program +
                       " to make one; install the packages xvfb and xauth, or set DISPLAY");
  setenv(under_xvfb, "1", 1);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  std::vector<const char *> command = {"xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", self.c_str()};
  for (char **argument = argv + 1; *argument != nullptr; ++argument)
    command.push_back(*argument);
  command.push_back(nullptr);
  execvp(command[0], const_cast<char *const *>(command.data()));
  throw InputError(std::string("xvfb-run could not be started: ") + std::strerror(errno));
}

} // namespace platen::apps::report
