#include "apps/io/pvd.h"

#include <fmt/format.h>
#include <vtkObject.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <iterator>
#include <sstream>
#include <stdexcept>

#include "apps/io/errors.h"
#include "apps/io/file.h"
#include "apps/io/numbers.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

std::string escaped(const std::string &text) {
  std::ostringstream result;
  vtkXMLUtilities::EncodeString(text.c_str(), VTK_ENCODING_NONE, result, VTK_ENCODING_NONE, 1);
  return result.str();
}

// What is wrong with a file is said by what is thrown; VTK would print its own words besides.
vtkSmartPointer<vtkXMLDataElement> read_xml(const std::filesystem::path &path) {
  const int warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::SetGlobalWarningDisplay(0);
  auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  vtkObject::SetGlobalWarningDisplay(warnings);
  return root;
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
    if (!std::filesystem::exists(path_.parent_path() / file))
      throw CheckpointError(fmt::format("{}: the frame {} is missing", path_.string(), file));
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
                   part, escaped(frames_[k].file));
  }
  write_text_aside(path_, text + "  </Collection>\n</VTKFile>\n");
}

} // namespace platen::apps
