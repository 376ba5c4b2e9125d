#include "apps/scene/version.h"

#include <string_view>

#ifdef PLATEN_COMMIT_HEADER
#include PLATEN_COMMIT_HEADER // defines PLATEN_COMMIT; written at each build
#endif
#ifndef PLATEN_COMMIT
#define PLATEN_COMMIT "unknown" // built outside the repository
#endif
#ifndef PLATEN_VERSION
#define PLATEN_VERSION "0.0.0"
#endif
#ifndef PLATEN_BUILD_TYPE
#define PLATEN_BUILD_TYPE "unknown build type"
#endif
#ifndef PLATEN_DEAL_II
#define PLATEN_DEAL_II "unknown"
#define PLATEN_TRILINOS "unknown"
#define PLATEN_VTK "unknown"
#endif

namespace platen::apps {

std::string version_line() {
  return "Platen " PLATEN_VERSION " (commit " PLATEN_COMMIT ", " PLATEN_BUILD_TYPE ")";
}

bool has_commit_of_its_own() {
  const std::string_view commit = PLATEN_COMMIT;
  return commit != "unknown" && commit.find("dirty") == std::string_view::npos;
}

std::string version_text() {
#if defined(__clang__)
  const std::string compiler = "Clang " __clang_version__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
  const std::string trilinos = PLATEN_TRILINOS;
  return version_line() + "\ncompiler " + compiler + "\ndeal.II " PLATEN_DEAL_II +
         (trilinos.empty() ? ", no Trilinos" : ", Trilinos " + trilinos) + ", VTK " PLATEN_VTK;
}

} // namespace platen::apps
