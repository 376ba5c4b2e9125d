// A study of a target in words and for study.json.
#pragma once

#include <string>

#include "apps/output/summary.h"
#include "apps/study/target_study.h"

namespace platen::apps {

// "43.21 MPa +- 1.9 %", and of a gain "1.49 +- 2.8 %".
std::string estimate_text(const TargetStudy &study, const TargetEstimate &estimate, double half);
// What is known after the last batch, and what is run next.
std::string look_text(const TargetStudy &study);
// All at the end; "" where nothing is known.
std::string text_of(const TargetStudy &study);

// For study.json: what repeats to the byte, and what runs took.
Json json_of(const TargetStudy &study);
Json costs_of(const TargetStudy &study);

} // namespace platen::apps
