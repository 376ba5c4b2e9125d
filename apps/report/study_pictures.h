// The pictures and the page of a study.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "apps/report/accuracy_results.h"
#include "apps/report/study_results.h"

namespace platen::apps::report {

// Strength, and its gain over free ends, against the coefficient of friction: a curve for each slenderness,
// bars of scatter, the laboratory's figures at dry steel. Platens that hold otherwise than by friction are
// left out. `cases` are alike but for platens and slenderness. Needs an X server; throws OutputError.
void draw_friction(const StudyResults &study, const std::vector<std::size_t> &cases,
                   const std::filesystem::path &png);

// Strength, and its ratio to that at slenderness 2, against height over width: a curve for each kind of
// platens. As above.
void draw_slenderness(const StudyResults &study, const std::vector<std::size_t> &cases,
                      const std::filesystem::path &png);

// Draws what the study varied into `folder` (made where it is not there), for each sphere radius and pressure
// apart, puts pictures and table on the page report.html there, and prints the same. Needs an X server;
// throws OutputError.
void write_study_report(const StudyResults &study, const std::filesystem::path &folder, std::ostream &out);

// The same of a study of accuracy: errors against seconds, a line for each knob.
void write_accuracy_report(const AccuracyResults &study, const std::filesystem::path &folder,
                           std::ostream &out);

} // namespace platen::apps::report
