#include "apps/io/pvd.h"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

#include "apps/io/errors.h"
#include "apps/io/file.h"
#include "apps/io/numbers.h"
#include "apps/io/pvtu.h"
#include "apps/io/vtk_xml.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

void require_frame(const std::filesystem::path &pvd, const std::filesystem::path &file) {
  const std::filesystem::path frame = pvd.parent_path() / file;
  const auto refuse = [&](const std::string &what) {
    throw CheckpointError(fmt::format("{}: the frame {} {}", pvd.string(), file.string(), what));
  };
  if (!std::filesystem::exists(frame)) refuse("is missing");
  if (frame.extension() != ".pvtu") return;
  const std::vector<std::filesystem::path> pieces = pieces_of(frame);
  if (pieces.empty()) refuse("is damaged");
  for (const std::filesystem::path &piece : pieces)
    if (!std::filesystem::exists(piece)) refuse("lacks its piece " + piece.filename().string());
}

} // namespace

PvdSeries::PvdSeries(std::filesystem::path path) : path_(std::move(path)) {}

void PvdSeries::append(double time, const std::string &file) {
  if (!frames_.empty() && !(time >= frames_.back().time))
    throw std::logic_error(
        fmt::format("{}: a frame at {} s after one at {} s", path_.string(), time, frames_.back().time));
  frames_.push_back({time, file});
  write();
}

void PvdSeries::resume(double up_to_time) {
  frames_.clear();
  if (this_rank().is_silent()) return;
  if (!std::filesystem::exists(path_)) return;
  const auto root = read_xml(path_);
  vtkXMLDataElement *collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (collection == nullptr) throw CheckpointError(path_.string() + ": not a whole ParaView collection");
  std::vector<Frame> kept;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement *entry = collection->GetNestedElement(k);
    const char *time_text = entry->GetAttribute("timestep"), *file = entry->GetAttribute("file");
    // The text itself is read: VTK's own conversion depends on the locale.
    const auto time = number_of(time_text == nullptr ? "" : time_text);
    if (!time || file == nullptr) throw CheckpointError(path_.string() + ": an entry without file or time");
    if (*time > up_to_time) continue;
    require_frame(path_, file);
    kept.push_back({*time, file});
  }
  frames_ = std::move(kept);
  write();
}

void PvdSeries::write() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  int part = 0;
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    part = k > 0 && frames_[k].time == frames_[k - 1].time ? part + 1 : 0;
    fmt::format_to(std::back_inserter(text),
                   "    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", frames_[k].time,
                   part, escaped_xml(frames_[k].file));
  }
  write_text_aside(path_, text + "  </Collection>\n</VTKFile>\n");
}

} // namespace platen::apps
