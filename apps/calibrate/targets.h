// What a scene wants of a calibration, from its text to numbers.
#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {

class Parameters;

// "Calibrate/Target 2", from 1
std::string section_of_target(std::size_t number);

// "tensile strength, friction angle": words of free_knobs, each once; "" is none. Throws ValueError.
std::vector<Knob> read_knobs(const std::string &text);
// "dry steel", "0.57": a face that is friction alone; "" is none. Throws ValueError.
std::vector<StudySurface> read_platens_of_target(const std::string &text);

// The unit of a target's value; "" of a curve, which has none.
std::string unit_of(TargetKind kind);

// The keys of Calibrate as targets, then the sections in their order. Throws InputError where one gives no
// value, or not such a one, or gives numbers without a kind.
std::vector<Target> targets_of(Parameters &parameters, const Calibrate &calibrate);

} // namespace platen::apps
