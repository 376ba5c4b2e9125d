// A folder of platen-calibrate: the user's own curves beside those that were found.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace platen::apps::report {

// The folder is of a calibration that has ended.
bool holds_calibration(const std::filesystem::path &folder);

// Stress against strain of curve.csv, the user's dashed black, that of the packings calibrated on, that of
// unseen ones. Needs a display; throws InputError where the file is damaged, OutputError.
void draw_calibrated_curve(const std::filesystem::path &csv, const std::filesystem::path &png);

// What was found over what was wanted, a bar for each target.
void draw_targets(const std::filesystem::path &folder, const std::filesystem::path &png);

// Targets, and every curve of the folder, on a page in `pictures`.
void write_calibration_report(const std::filesystem::path &folder, const std::filesystem::path &pictures,
                              std::ostream &out);

} // namespace platen::apps::report
