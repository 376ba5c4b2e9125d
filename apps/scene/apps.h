// The apps that read scenes: what each is called, what it says of itself, what its command line has.
#pragma once

#include <array>

#include "apps/scene/command_line.h"

namespace platen::apps {

// Kinds of studies by their word on the command line, as StudyKind (apps/study/cases.h) numbers them.
inline constexpr std::array study_words{"friction", "slenderness", "size",  "packing",
                                        "rate",     "accuracy",    "target"};

AppDescription description_of(AppKind kind);

} // namespace platen::apps
