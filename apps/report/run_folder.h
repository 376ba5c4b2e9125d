// An output folder of a run, read as far as a report needs it, and the moments of the test: the peak, the
// fall to 0.8 of it, the end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/report/csv.h"
#include "apps/report/frames.h"

namespace platen::apps::report {

struct Moments {
  std::size_t peak_row = 0;             // row of the history
  double peak_stress = 0;               // Pa, mean of both platens that load; negative for a tension test
  double peak_time = 0;                 // s
  std::optional<double> post_peak_time; // s; nothing where the stress never fell so far
  double end_time = 0;                  // s
};

// Mean of the stresses at both platens of an axis (0 x, 1 y, 2 z), Pa, one per row of the history;
// compression positive.
std::vector<double> platen_stress(const CsvTable &history, int axis = 2);

// The peak is the largest stress by size, so that a tension test has one too. Time of the fall is
// interpolated between samples. Throws InputError where the history has no row or no finite stress.
Moments moments_of(const CsvTable &history, int axis = 2);

struct Run {
  std::filesystem::path folder;
  std::string name;  // last part of the path, for legends
  std::string title; // Scene / Title, as long as it is true (head.h); the name where the scene gives none
  CsvTable history;
  int axis = 2; // that the test loads: 0 x, 1 y, 2 z
  Moments moments;
  std::size_t zero = 0; // row at the end of the consolidation, from which strains count; else the first
  Json summary;         // null where the run wrote none
  std::optional<CsvTable> cracks;                         // "mode" as words
  std::optional<CsvTable> events;                         // acoustic ones
  FrameSeries specimen, bonds, platens, contacts, sleeve; // empty where the run wrote none
  std::vector<std::string> remarks;                       // what is not there, one sentence each

  void take_moments(); // from history and summary
  // Along the loaded axis, one per row of the history: Pa; of the platens, 1.
  std::vector<double> stress() const { return platen_stress(history, axis); }
  std::vector<double> strain() const; // from the end of the consolidation
  std::string stress_title() const;   // "Axial stress (MPa)", "Stress along x (MPa)"
  std::string strain_title()
      const; // "Axial strain between platens (mm/m)", "... from the end of consolidation"
  std::string strain_origin() const; // " from the end of consolidation"; empty without one
  // A column less what it was at the end of the consolidation. Throws InputError where there is none.
  std::vector<double> since_zero(const std::string &column) const;
  // The rows from the end of the consolidation on.
  std::vector<double> from_zero(std::vector<double> values) const;
  // Whether the run went over its peak; nothing where the summary does not say.
  std::optional<bool> peak_reached() const;
  // Time at which cracks are counted: the fall to 0.8 of the peak, or the end where it did not come.
  double pattern_time() const { return moments.post_peak_time.value_or(moments.end_time); }
  // The same in words, for captions: "the fall to 0.8 of the peak" or "the end".
  std::string pattern_words() const;
};

// What a .prm sets an entry to, "Platens/Top/Surface"; empty where it does not.
std::string scene_entry(const std::filesystem::path &scene, const std::string &path);

// The number of such an entry in the scene.prm of a folder of results, converted to `si_unit` as scenes are
// read (apps/scene/units.h); NaN where the file or the entry is not there, or is empty. Throws InputError
// where the text is no such number.
double number_of_scene(const std::filesystem::path &folder, const std::string &path,
                       const std::string &si_unit);

// Reads history, summary, cracks and the lists of frames. Only history.csv must be there; what else is
// missing becomes a remark. Throws InputError where the folder or the history is missing, or any file is
// damaged.
Run read_run(const std::filesystem::path &folder);

} // namespace platen::apps::report
