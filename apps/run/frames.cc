#include "apps/run/frames.h"

#include <utility>

#include "apps/output/file.h"
#include "apps/output/output_folder.h"
#include "apps/run/view_script.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

// Frames on the way to the target strain, where the scene leaves it open.
constexpr double automatic_frames = 24;

} // namespace

Frames::Frames(const Scene &scene, coupling::PlatenTest &test, const Results &results,
               const std::filesystem::path &folder, bool in_parallel, double expected_steps)
    : test_(test),
      results_(results),
      folder_(folder),
      in_parallel_(in_parallel),
      schedule_(scene.output.fields_every, automatic_frames, expected_steps, test) {
  for (const char *series : {"specimen", "bonds", "platens", "sleeve", "contacts"})
    series_.emplace(series, PvdSeries(folder / (std::string(series) + ".pvd")));
  create_folder(folder / "frames");
  write_text_aside(OutputPaths(folder).view(), view_script);
}

void Frames::resume(const FileMarks &marks) {
  last_time_ = marks.last_frame;
  count_ = static_cast<int>(marks.frames);
  for (auto &[name, series] : series_)
    series.resume(last_time_);
}

void Frames::observe(const Moment &now) {
  if (!schedule_.is_due() && !now.ends && results_.pattern().time != test_.time()) return;
  dem::StageClock::Lap lap(test_.model.clock, dem::Stage::output);
  write();
}

void Frames::write() {
  if (test_.time() <= last_time_) return;
  if (!this_rank().is_silent()) {
    Frame frame = frame_of(test_, results_.moves_with(test_), results_.largest_openings(), count_);
    wait();
    writing_ = std::async(in_parallel_ ? std::launch::async : std::launch::deferred,
                          [this, frame = std::move(frame)] { store(frame); });
    if (!in_parallel_) wait();
  }
  last_time_ = test_.time();
  ++count_;
}

void Frames::wait() {
  if (writing_.valid()) writing_.get();
}

// A run must not resume after frames that are not there.
void Frames::mark(FileMarks &marks) {
  wait();
  marks.last_frame = last_time_;
  marks.frames = count_;
}

void Frames::finish() {
  write();
  wait();
}

void Frames::store(const Frame &frame) {
  for (const FrameFile &file : frame.files) {
    file.write(folder_ / file.name);
    series_.at(file.series).append(frame.time, file.name);
  }
}

} // namespace platen::apps
