// What a summary says of how a specimen has failed: cones, pattern, crack planes, acoustic emission.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/run/results.h"
#include "apps/scene/scene.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Whether platens press the specimen along its axis until it fails: cones and patterns are told of no other
// test.
bool tells_pattern(const Scene &scene, const coupling::PlatenTest &problem);

// Adds the keys cone_top, cone_bottom (by displacement since the peak), dead_zone_top, dead_zone_bottom,
// sound_cone_top, sound_cone_bottom (by damage), pattern, pattern_reasons and crack_planes, of 0.8 of the
// peak and with "final_" before them of the end, crack_rose and acoustic; null where not measured.
void add_failure(nlohmann::ordered_json &to, const Scene &scene, const coupling::PlatenTest &problem,
                 const Results &results);

// For the screen: "r0 0.97, 24.1 mm high, half-angle 44 degrees, 0.13 of the volume, confidence 0.58", or why
// there is none; the measure that decided the pattern.
std::string cone_words(const dem::DeadZone &zone);
std::string cone_words(const dem::ConePiece &piece);
std::string reason_words(const dem::FailureMeasures &measures);
double largest_magnitude(const Emission &emission); // NaN without events

} // namespace platen::apps
