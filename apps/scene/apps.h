// The apps that read scenes: what each is called, what it says of itself, what its command line has.
#pragma once

#include <array>

#include "apps/scene/command_line.h"

namespace platen::apps {

// Kinds of studies by their word on the command line, as StudyKind (apps/study/cases.h) numbers them.
inline constexpr std::array study_words{"friction", "slenderness", "size",  "packing",
                                        "rate",     "accuracy",    "target"};

// What platen-report, which reads results instead of scenes, is for.
inline constexpr const char *report_purpose =
    "Turns an output folder of a run, of a study, or of a calibration by a curve, into pictures (PNG) and "
    "one "
    "HTML page, and compares several runs.";

AppDescription description_of(AppKind kind);

} // namespace platen::apps
