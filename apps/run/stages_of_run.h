// What a run says of its loading stages.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/run/results.h"
#include "apps/scene/scene.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Adds `stages`, of those that the scene writes: where each ended and by what. The one that a run was in when
// it stopped ended by "stopped", or by "stop at residual".
void add_stages(nlohmann::ordered_json &to, const Scene &scene, const coupling::PlatenTest &problem,
                const Results &results);

// Of a stage (from 0) whose time was over before its stresses were borne: "stage 1 did not settle in its
// time: top 3.61 of 4 MPa; ..."; empty of any other.
std::string unsettled_words(const coupling::PlatenTest &problem, std::size_t stage);

} // namespace platen::apps
