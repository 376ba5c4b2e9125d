// platen-calibrate on some hundred spheres.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/calibrate/run_calibrate.h"
#include "apps/programs.h"
#include "scratch_folder.h"

namespace platen::apps {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;
using testing::contains;
using testing::content_of;

inline const char *const calibration_text = R"(subsection Scene
  set Seed = 4
end
subsection Specimen
  set Radius = 8 mm
  set Height = 20 mm
  set Sphere radius = 1.2 mm
  set Radius spread = 0.25
  set Ends = ground
  set End layer = 0.5
end
subsection Bond
  set Modulus = 36 GPa
  set Stiffness ratio = 0.4
  set Tensile strength = 9.5 MPa
  set Shear strength = 38 MPa
  set Friction angle = 45 degree
  set Moment contribution = 0.3
  set Gap = 0.05 R_min
end
subsection Platens
  set Friction static = 0.57
end
subsection Loading
  set Axial rate = 0.05 m/s
  set Target strain = 0.02
end
subsection Calibrate
  set Seeds = 2
  set Verification seeds = 1
end
)";

// Targets by their lines, and further entries: those without a section are of Calibrate.
inline Texts asked(const Texts &targets, const Texts &further = {}) {
  Texts entries;
  for (const std::string &line : targets)
    entries.push_back("Calibrate/Target " + std::to_string(entries.size() + 1) + " = " + line);
  for (const std::string &entry : further)
    entries.push_back(entry.find('/') < entry.find('=') ? entry : "Calibrate/" + entry);
  return entries;
}
// The same on one packing, judged by no other.
inline Texts asked_of_one(const Texts &targets, const Texts &further = {}) {
  Texts entries = asked(targets, further);
  entries.insert(entries.begin(), {"Calibrate/Seeds = 1", "Calibrate/Verification seeds = 0"});
  return entries;
}

inline std::string with_unit(double number, const char *unit) {
  std::ostringstream text;
  text.precision(12);
  text << number << unit;
  return text.str();
}

class CalibrateApp : public testing::ScratchFolder {
protected:
  CalibrateApp() : folder(folder_) {
    testing::put(folder / "case.prm", calibration_text);
    setenv("PLATEN_CACHE", "none", 1); // what is tested is made here, not found
  }
  ~CalibrateApp() override { setenv("PLATEN_CACHE", "none", 1); }

  Scene read(const Texts &entries) const {
    return read_scene((folder / "case.prm").string(), entries, program("calibrate"));
  }
  CommandLine command(const Texts &entries, const std::string &to) const {
    CommandLine line;
    line.scene = (folder / "case.prm").string(), line.output = (folder / to).string();
    line.overrides = entries;
    line.quiet = true, line.threads = 1;
    return line;
  }
  // A calibration that does not meet its targets ends with status 1 and says by how much, any other with 0.
  nlohmann::json run(const Texts &entries, const std::string &to, bool resume = false,
                     int threads = 1) const {
    CommandLine line = command(entries, to);
    line.resume = resume, line.threads = threads;
    const int status = run_calibrate(line, read(entries));
    const nlohmann::json summary = json_in(to);
    bool met = true;
    if (summary.contains("targets"))
      for (const auto &target : summary["targets"])
        met = met && target.value("met", target.value("met_in_training", false));
    EXPECT_EQ(status, met ? status_done : status_check_failed);
    EXPECT_EQ(summary.contains("targets_missed") && !summary["targets_missed"].empty(), !met);
    return summary;
  }
  std::string dry_run(const Texts &entries) const {
    CommandLine line = command(entries, "dry");
    line.dry_run = true;
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(run_calibrate(line, read(entries)), status_done);
    return ::testing::internal::GetCapturedStdout();
  }
  std::string text_in(const std::string &file) const { return content_of(folder / file); }
  nlohmann::json json_in(const std::string &results) const {
    return nlohmann::json::parse(text_in(results + "/summary.json"));
  }
  Scene found_in(const std::string &results) const {
    return read_scene((folder / results / "found.prm").string(), {}, program("compress"));
  }

  const fs::path folder;
};

inline double mean(const nlohmann::json &summary, const char *key, const char *of = "training") {
  return summary[of][key]["mean"].get<double>();
}

} // namespace platen::apps
