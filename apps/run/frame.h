// A frame for ParaView as it is at one moment: its data are copied, so that it can be written in parallel
// with the computation.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "coupling/platen_test.h"
#include "dem/measure/openings.h"

namespace platen::apps {

// One file of a frame. A series of platens has as many at one time as there are platens.
struct FrameFile {
  std::string series; // "specimen", "bonds", "platens", "sleeve", "contacts"
  std::string name;   // "frames/specimen_000012.vtu"
  std::function<void(const std::filesystem::path &)> write; // throws OutputError
};

struct Frame {
  double time = 0; // s
  std::vector<FrameFile> files;
};

// `moves_with` (Results::moves_with) is left out if it is empty, and so are openings where the test keeps no
// crack log. On several ranks all have the whole
// specimen, and the first one writes.
Frame frame_of(const coupling::PlatenTest &problem, const std::vector<int> &moves_with,
               const dem::LargestOpenings &largest, int number);

} // namespace platen::apps
