// All programs that read scenes.
#pragma once

#include "apps/scene/program.h"

namespace platen::apps {

const std::vector<Program> &programs();
// "compress" or "platen-compress". Throws std::out_of_range for one that does not exist.
const Program &program(const std::string &word);

// What platen-report, which reads results instead of scenes, is for.
inline constexpr const char *report_purpose =
    "Turns an output folder of a run, of a study, or of a calibration by a curve, into pictures (PNG) and "
    "one "
    "HTML page, and compares several runs.";

} // namespace platen::apps
