#include "apps/scene/version.h"

#include <deal.II/base/config.h> // macros only
#include <vtkVersionMacros.h>

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

namespace platen::apps {

std::string version_line() {
  return "Platen " PLATEN_VERSION " (commit " PLATEN_COMMIT ", " PLATEN_BUILD_TYPE ")";
}

std::string version_text() {
#if defined(__clang__)
  const std::string compiler = "Clang " __clang_version__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
#ifdef DEAL_II_TRILINOS_VERSION_MAJOR
  const std::string trilinos = ", Trilinos " + std::to_string(DEAL_II_TRILINOS_VERSION_MAJOR) + "." +
                               std::to_string(DEAL_II_TRILINOS_VERSION_MINOR) + "." +
                               std::to_string(DEAL_II_TRILINOS_VERSION_SUBMINOR);
#else
  const std::string trilinos = ", no Trilinos";
#endif
  return version_line() + "\ncompiler " + compiler + "\ndeal.II " DEAL_II_PACKAGE_VERSION + trilinos +
         ", VTK " VTK_VERSION;
}

} // namespace platen::apps
