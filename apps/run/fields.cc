#include "apps/run/fields.h"

#include <utility>

#include "apps/output/file.h"
#include "apps/output/output_folder.h"
#include "apps/run/view_script.h"
#include "apps/scene/rank.h"

namespace platen::apps {

FieldSeries::FieldSeries(const std::filesystem::path &folder, bool in_parallel)
    : folder_(folder), in_parallel_(in_parallel) {
  for (const char *series : {"specimen", "bonds", "platens", "sleeve", "contacts"})
    series_.emplace(series, PvdSeries(folder / (std::string(series) + ".pvd")));
  create_folder(folder / "frames");
  write_text_aside(OutputPaths(folder).view(), view_script);
}

void FieldSeries::write(const coupling::PlatenTest &problem, const std::vector<int> &moves_with) {
  if (problem.time() <= last_time_) return;
  if (!this_rank().is_silent()) {
    Frame frame = frame_of(problem, moves_with, count_);
    finish();
    writing_ = std::async(in_parallel_ ? std::launch::async : std::launch::deferred,
                          [this, frame = std::move(frame)] { store(frame); });
    if (!in_parallel_) finish();
  }
  last_time_ = problem.time();
  ++count_;
}

void FieldSeries::finish() {
  if (writing_.valid()) writing_.get();
}

void FieldSeries::resume(double last_time, int count) {
  last_time_ = last_time;
  count_ = count;
  for (auto &[name, series] : series_)
    series.resume(last_time);
}

void FieldSeries::store(const Frame &frame) {
  for (const FrameFile &file : frame.files) {
    file.write(folder_ / file.name);
    series_.at(file.series).append(frame.time, file.name);
  }
}

} // namespace platen::apps
