#include "apps/output/pvd.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "apps/output/numbers.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

constexpr const char *begin =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
constexpr const char *end = "  </Collection>\n</VTKFile>\n";

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
  if (this_rank().is_silent() || !std::filesystem::exists(path_)) return;
  std::ifstream stream(path_);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.find(end) == std::string::npos)
    throw CheckpointError(path_.string() + ": not a whole ParaView collection");
  static const std::regex entry("<DataSet timestep=\"([^\"]*)\"[^>]* file=\"([^\"]*)\"/>");
  std::vector<Frame> kept;
  for (std::sregex_iterator one(text.begin(), text.end(), entry), none; one != none; ++one) {
    const auto time = number_of((*one)[1].str());
    const std::string file = (*one)[2];
    if (!time) throw CheckpointError(path_.string() + ": an entry without a time");
    if (*time > up_to_time) break;
    if (!std::filesystem::exists(path_.parent_path() / file))
      throw CheckpointError(path_.string() + ": the frame " + file + " is missing");
    kept.push_back({*time, file});
  }
  frames_ = std::move(kept);
  write();
}

void PvdSeries::write() const {
  std::string text = begin;
  int part = 0;
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    part = k > 0 && frames_[k].time == frames_[k - 1].time ? part + 1 : 0;
    fmt::format_to(std::back_inserter(text),
                   "    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", frames_[k].time,
                   part, frames_[k].file);
  }
  write_text_aside(path_, text + end);
}

} // namespace platen::apps
