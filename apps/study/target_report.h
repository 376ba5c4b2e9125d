// A study of a target in words and for study.json.
#pragma once

#include <string>

#include "apps/output/summary.h"
#include "apps/study/target_study.h"

namespace platen::apps {

// What another size of spheres does to the figure: that of spheres 1.25 times as large, relative.
struct SizeEffect {
  double change = 0;
  double half = 0; // of its interval; 0: by the law of bench/results/sizes.md
  bool measured = false;
};
SizeEffect size_effect(const TargetStudy &study);

// Parts of the half interval, relative to the figure; their squares sum up to its square.
struct ErrorParts {
  double packing = 0, chaos = 0, speed = 0, step = 0;
};
ErrorParts parts_of(const Precision &precision, double half, double step_error);

std::string figure_words(const TargetStudy &study);
const char *verdict_words(Verdict verdict);
double figure_of(const TargetEstimate &of); // a strength in Pa, a gain without unit
// Seconds of one core for so much work, by what runs took so far.
double seconds_of(const TargetStudy &study, double work);

// One slow speed in place of the study: all known beforehand, or by the runs of the first look.
OneSpeed one_speed_of_oracle(const TargetStudy &study);
OneSpeed one_speed_of_pilot(const TargetStudy &study);

// "43.21 MPa +- 1.9 %", and of a gain "1.49 +- 2.8 %".
std::string estimate_text(const TargetStudy &study, const TargetEstimate &estimate, double half);
// What is known after the last batch, and what is run next.
std::string look_text(const TargetStudy &study);
// All at the end.
std::string text_of(const TargetStudy &study);

// For study.json: what repeats to the byte, and what runs took.
Json json_of(const TargetStudy &study);
Json costs_of(const TargetStudy &study);

} // namespace platen::apps
