// Frames for ParaView: specimen, bonds, platens, sleeve and the contacts with them at the same times.
#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "apps/output/pvd.h"
#include "apps/run/frame.h"
#include "coupling/platen_test.h"

namespace platen::apps {

class FieldSeries {
public:
  // Frames are written to `folder`/frames, the .pvd files and the script that shows them to `folder`. With
  // `in_parallel` another thread writes a frame while the computation goes on to the next one.
  FieldSeries(const std::filesystem::path &folder, bool in_parallel);

  // Writes one frame of everything; a second call at the same time does nothing. `moves_with`
  // (Results::moves_with) is left out if it is empty. Returns as soon as the frame before is on the disk.
  // Throws OutputError, in parallel that of the frame before.
  void write(const coupling::PlatenTest &problem, const std::vector<int> &moves_with);
  // Returns when all frames are on the disk. Throws OutputError.
  void finish();
  // Continues after the frame at `last_time` (s); `count` is the number of frames up to it.
  void resume(double last_time, int count);
  double last_time() const { return last_time_; } // s, of the last frame; -1 before the first
  int count() const { return count_; }

private:
  void store(const Frame &frame);

  std::filesystem::path folder_;
  bool in_parallel_;
  std::map<std::string, PvdSeries> series_;
  double last_time_ = -1;
  int count_ = 0;
  std::future<void> writing_; // the last member: its thread uses the others until it is destroyed
};

} // namespace platen::apps
