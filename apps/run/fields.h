// Frames for ParaView: specimen, bonds, platens, sleeve and the contacts with them on one clock.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "apps/io/pvd.h"
#include "apps/io/write_queue.h"
#include "apps/run/frame.h"
#include "coupling/platen_test.h"

namespace platen::apps {

class FieldSeries {
public:
  // Frames land in `folder`/frames, the .pvd files and the script that shows them in `folder`. Specimens of
  // more spheres than are in a piece are written in pieces, which ranks share out. Collective, and then not
  // `beside` the computation, by a thread of their own.
  FieldSeries(const std::filesystem::path &folder, std::size_t spheres_in_a_piece, bool beside = false);

  // Writes one frame of everything; a second call at the same time does nothing. `moves_with`
  // (Results::moves_with) is left out where it is empty. Throws OutputError, beside the computation that of
  // an earlier frame.
  void write(const coupling::PlatenTest &problem, const std::vector<int> &moves_with);
  // Returns once all frames are on the disk. Throws OutputError.
  void finish() { queue_.finish(); }
  // Goes on after the frame of `last_time` (s), the number of frames written so far being `count`.
  void resume(double last_time, int count);
  double last_time() const { return last_time_; } // s, of the last frame; -1 before the first
  int count() const { return count_; }

private:
  void store_spheres(const Frame &frame);
  void store_bonds(const Frame &frame);
  void store_boundaries(const Frame &frame);
  void store_contacts(const Frame &frame);

  std::filesystem::path folder_;
  std::size_t in_a_piece_;
  PvdSeries specimen_, bonds_, platens_, sleeve_, contacts_;
  double last_time_ = -1;
  int count_ = 0;
  WriteQueue queue_; // the last member: what it does needs the others
};

} // namespace platen::apps
