// Loading stages as a scene writes them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "coupling/stage_settings.h"

namespace platen::apps {

constexpr std::size_t most_stages = 20;

// One of "Loading/Stage 1" ... as it is read.
struct StageSection {
  std::array<std::optional<coupling::SideControl>, coupling::all_side_groups.size()> controls; // by side
  double ramp = 0, hold = 0;                                                                   // s
  std::vector<coupling::StageUntil> until;
  bool given() const;
};

// "Loading/Stage 2", from 1; "Lateral x"
std::string section_of_stage(std::size_t number);
std::string key_of(coupling::SideGroup group);

// "rate 0.05 m/s", "share of Axial 0.5", "hold"; "" is none. Throws ValueError.
std::optional<coupling::SideControl> read_control(const std::string &text);
// "strain 0.4 %, share of peak 0.5, Left stress 5 MPa, settled"; "" is none. Throws ValueError.
std::vector<coupling::StageUntil> read_until(const std::string &text);

// Those that are given, in their order.
std::vector<coupling::StageSettings> stages_of(const std::array<StageSection, most_stages> &sections);

} // namespace platen::apps
