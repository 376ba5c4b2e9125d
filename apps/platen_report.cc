// platen-report: turns an output folder into pictures and a page, and compares several.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "apps/output/summary.h"
#include "apps/programs.h"
#include "apps/report/accuracy_study.h"
#include "apps/report/calibration.h"
#include "apps/report/display.h"
#include "apps/report/fields.h"
#include "apps/report/other_results.h"
#include "apps/report/parameter_study.h"
#include "apps/report/platen_study.h"
#include "apps/report/report.h"
#include "apps/output/state_listing.h"
#include "apps/report/target_study.h"
#include "apps/scene/errors.h"
#include "apps/scene/rank.h"
#include "apps/scene/version.h"

namespace {

using namespace platen::apps;

struct Wishes {
  std::string folder, pictures; // pictures: empty for FOLDER/pictures
  std::vector<std::string> others;
  std::string other_state; // of --state-diff
  bool fields = false, quiet = false, state = false;
};

int tell_state(const Wishes &wishes) {
  if (wishes.state) list_state(wishes.folder, std::cout);
  if (wishes.other_state.empty()) return status_done;
  return compare_states(wishes.folder, wishes.other_state, std::cout) ? status_done
                                                                              : status_check_failed;
}

void report_on(const Wishes &wishes, char **argv) {
  const std::filesystem::path beside = std::filesystem::path(wishes.folder) / "pictures",
                              pictures =
                                  wishes.pictures.empty() ? beside : std::filesystem::path(wishes.pictures);
  std::ostringstream unread;
  std::ostream &out = wishes.quiet ? static_cast<std::ostream &>(unread) : std::cout;
  if (report::holds_study(wishes.folder)) {
    if (!wishes.others.empty()) throw InputError("--compare is for runs; " + wishes.folder + " is a study");
    if (wishes.fields) throw InputError("--fields is for runs; " + wishes.folder + " is a study");
    const std::string kind = report::finished_study(wishes.folder).value("kind", "");
    if (report::is_parameter_study(kind)) {
      const report::ParameterStudy study = report::read_parameter_study(wishes.folder);
      report::ensure_display(argv);
      return report::write_parameter_report(study, pictures, out);
    }
    if (kind == "accuracy") {
      const report::AccuracyResults study = report::read_accuracy(wishes.folder);
      report::ensure_display(argv);
      return report::write_accuracy_report(study, pictures, out);
    }
    if (kind == "target") {
      const report::TargetResults study = report::read_target(wishes.folder);
      report::ensure_display(argv);
      return report::write_target_report(study, pictures, out);
    }
    const report::StudyResults study = report::read_study(wishes.folder);
    report::ensure_display(argv);
    return report::write_study_report(study, pictures, out);
  }
  if (report::holds_calibration(wishes.folder)) {
    if (!wishes.others.empty() || wishes.fields)
      throw InputError("--compare and --fields are for runs; " + wishes.folder + " is a calibration");
    report::ensure_display(argv);
    return report::write_calibration_report(wishes.folder, pictures, out);
  }
  if (const auto read = report::reader_of(wishes.folder)) {
    if (!wishes.others.empty() || wishes.fields)
      throw InputError("--compare and --fields are for runs; " + wishes.folder + " is of " +
                       report::app_of(wishes.folder));
    return read(
        wishes.folder, pictures, [argv]() { report::ensure_display(argv); }, out);
  }
  std::vector<report::Run> runs{report::read_run(wishes.folder)};
  for (const std::string &other : wishes.others)
    runs.push_back(report::read_run(other));
  if (wishes.fields && !report::tells_stress(runs.front()))
    throw InputError(wishes.folder +
                     ": no fields can be made: they need specimen.pvd with stress, contacts.pvd "
                     "and packing_fraction in summary.json");
  report::ensure_display(argv);
  report::write_report(runs, pictures, out);
  if (wishes.fields) out << "fields: " << report::write_fields(runs.front()).string() << '\n';
}

int fail(const std::exception &error, int status) {
  std::cout.flush();
  std::string text = error.what();
  for (char &c : text) // names of files may hold what a terminal obeys
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f) c = '?';
  before_reporting_a_failure();
  std::cerr << "error: " << text << '\n';
  after_reporting_a_failure(status);
  return status;
}

} // namespace

int main(int argc, char **argv) {
  CLI::App app{report_purpose, "platen-report"};
  Wishes wishes;
  app.add_option("folder", wishes.folder, "Output folder of a run or a study");
  app.add_option("-c,--compare", wishes.others, "Further output folders, drawn and tabled beside the first");
  app.add_option("-o,--output", wishes.pictures, "Folder for pictures and page; default: FOLDER/pictures");
  app.add_flag("--fields", wishes.fields,
               "Also write stress, strain, displacement and damage of all frames on one grid: fields.pvd for "
               "ParaView, into FOLDER");
  app.add_flag("--state", wishes.state,
               "List what the newest checkpoint holds (names, units, sizes, least and largest number); draws "
               "nothing");
  app.add_option("--state-diff", wishes.other_state,
                 "Tell the first difference to the newest checkpoint of another output folder, and end with "
                 "status 1 where there is one; draws nothing");
  app.add_flag("-q,--quiet", wishes.quiet, "Print errors only");
  bool version = false, json = false;
  app.add_flag("--version", version, "Print version and libraries and exit");
  app.add_flag("--json", json, "With --version: as JSON");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? status_done : status_bad_input;
  }
  if (version) {
    std::cout << (json ? version_json() : version_text()) << '\n';
    return status_done;
  }
  if (json) return fail(InputError("--json needs --version"), status_bad_input);
  if (wishes.folder.empty()) return fail(InputError("no folder is given. See --help"), status_bad_input);
  try {
    require_one_process("platen-report");
    if (wishes.state || !wishes.other_state.empty()) return tell_state(wishes);
    report_on(wishes, argv);
  } catch (const InputError &error) {
    return fail(error, status_bad_input);
  } catch (const Json::exception &error) { // of another kind than the programs write
    return fail(InputError(wishes.folder +
                           ": summary.json or study.json holds what no run writes there: " + error.what()),
                status_bad_input);
  } catch (const std::exception &error) { // OutputError, file system, memory
    return fail(error, status_output);
  }
  return status_done;
}
