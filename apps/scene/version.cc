#include "apps/scene/version.h"

#include <string_view>

#include <nlohmann/json.hpp>

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

namespace {

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

} // namespace

std::string version_line() {
  return "Platen " PLATEN_VERSION " (commit " PLATEN_COMMIT ", " PLATEN_BUILD_TYPE ")";
}

bool has_commit_of_its_own() {
  const std::string_view commit = PLATEN_COMMIT;
  return commit != "unknown" && commit.find("dirty") == std::string_view::npos;
}

std::string version_text() {
  const std::string trilinos = PLATEN_TRILINOS;
  return version_line() + "\ncompiler " + compiler() + "\ndeal.II " PLATEN_DEAL_II +
         (trilinos.empty() ? ", no Trilinos" : ", Trilinos " + trilinos) + ", VTK " PLATEN_VTK;
}

std::string version_json() {
  const auto or_null = [](const std::string &text, const std::string &unknown) {
    return text == unknown ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
  };
  const std::string commit = PLATEN_COMMIT;
  nlohmann::ordered_json json;
  json["version"] = PLATEN_VERSION;
  json["commit"] = or_null(commit.substr(0, commit.find("-dirty")), "unknown");
  json["changed"] = commit.find("dirty") != std::string::npos;
  json["build_type"] = PLATEN_BUILD_TYPE;
  json["compiler"] = compiler();
  json["deal.II"] = PLATEN_DEAL_II;
  json["trilinos"] = or_null(PLATEN_TRILINOS, "");
  json["vtk"] = PLATEN_VTK;
  return json.dump();
}

} // namespace platen::apps
