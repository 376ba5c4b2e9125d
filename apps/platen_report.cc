// platen-report: turns an output folder into pictures, and compares several.
#include <CLI/CLI.hpp>
#include <iostream>

#include "apps/report/display.h"
#include "apps/report/report.h"
#include "apps/scene/errors.h"

namespace {

int fail(const std::exception &error, int status) {
  std::cerr << "platen-report: error: " << error.what() << '\n';
  return status;
}

} // namespace

int main(int argc, char **argv) {
  using namespace platen::apps;
  using namespace platen::apps::report;
  CLI::App app{"Turns an output folder of a run into pictures (PNG), and compares several runs."};
  std::string folder, pictures;
  std::vector<std::string> others;
  app.add_option("folder", folder, "output folder of a run")->required();
  app.add_option("-c,--compare", others, "further output folders, drawn and tabled beside the first");
  app.add_option("-o,--output", pictures, "folder for the pictures; default: FOLDER/pictures");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? status_done : status_bad_input;
  }

  try {
    std::vector<Run> runs{read_run(folder)};
    for (const std::string &other : others)
      runs.push_back(read_run(other));
    ensure_display(argv);
    const std::filesystem::path beside = std::filesystem::path(folder) / "pictures";
    write_report(runs, pictures.empty() ? beside : std::filesystem::path(pictures), std::cout);
  } catch (const OutputError &error) {
    return fail(error, status_output);
  } catch (const std::exception &error) {
    return fail(error, status_bad_input);
  }
  return status_done;
}
