// Frames for ParaView: specimen, bonds, platens, sleeve and the contacts with them at the same times.
#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <string>

#include "apps/output/pvd.h"
#include "apps/run/frame.h"
#include "apps/run/observer.h"
#include "apps/run/results.h"
#include "apps/scene/scene.h"

namespace platen::apps {

class Frames : public Observer {
public:
  // Frames are written to `folder`/frames, the .pvd files and the script that shows them to `folder`. With
  // `in_parallel` another thread writes a frame while the computation goes on to the next one; what it
  // throws, OutputError, is thrown with the next frame.
  Frames(const Scene &scene, coupling::PlatenTest &test, const Results &results,
         const std::filesystem::path &folder, bool in_parallel, double expected_steps);
  void write(); // one frame of everything; a second one at the same time does nothing
  // Goes on after the frames that a checkpoint marks.
  void resume(const FileMarks &marks);

  double steps_until_due() const override { return schedule_.steps_until_due(); }
  Gathered needs() const override { return schedule_.is_due() ? Gathered::everything : Gathered::nothing; }
  // When it is due, at the end, and of the state that damage and opening are measured in.
  void observe(const Moment &now) override;
  void mark(FileMarks &marks) override;
  void finish() override;

private:
  void wait(); // until all frames are on the disk
  void store(const Frame &frame);

  coupling::PlatenTest &test_;
  const Results &results_;
  std::filesystem::path folder_;
  bool in_parallel_;
  Schedule schedule_;
  std::map<std::string, PvdSeries> series_;
  double last_time_ = -1; // s, of the last frame
  int count_ = 0;
  std::future<void> writing_; // the last member: its thread uses the others until it is destroyed
};

} // namespace platen::apps
