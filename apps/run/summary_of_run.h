// summary.json of a test between platens, and what the screen shows of it.
#pragma once

#include <string>

#include "apps/output/summary.h"
#include "apps/run/test_record.h"

namespace platen::apps {

// All figures and their validity. status: "done", "stopped" or "failed". Numbers that were not measured are
// NaN, written null; a figure is null where `validity` has reasons against it.
Json summary_of_run(const std::string &status, const TestRecord &test);

// A few lines for the screen: strength, strains, moduli, damage, energy; each reason against figures once.
std::string report_of_run(const Json &summary);

// "platen-compress" or "platen-brazilian".
const char *app_of(const coupling::PlatenTest &problem);

} // namespace platen::apps
