#include "apps/output/run_log.h"

#include <fmt/chrono.h>

#include <ctime>
#include <iostream>

#include "apps/output/errors.h"
#include "apps/output/machine.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

std::string head(const RunHeader &header) {
  const Machine machine = this_machine();
  std::string text = header.version;
  if (text.empty() || text.back() != '\n') text += '\n';
  return text + fmt::format(
                    "started {:%Y-%m-%d %H:%M:%S} UTC: {}\n"
                    "machine {}, {} cores, {:.1f} GB, {}\n"
                    "threads {}\n",
                    fmt::gmtime(std::time(nullptr)), header.command, machine.processor, machine.cores,
                    1e-9 * static_cast<double>(machine.memory_bytes), machine.system, header.threads);
}

} // namespace

RunLog::RunLog(Loudness loudness) : RunLog(loudness, std::cout, std::cerr) {}

RunLog::RunLog(Loudness loudness, std::ostream &output, std::ostream &errors)
    : loudness_(loudness), output_(output), errors_(errors) {}

void RunLog::open(const std::filesystem::path &path, bool append, const RunHeader &header) {
  file_ = OutputFile(path, append ? OutputFile::Mode::append : OutputFile::Mode::replace);
  opened_ = true;
  std::error_code none;
  const std::string gap = append && std::filesystem::file_size(path, none) > 0 ? "\n" : "";
  write(gap + head(header) + std::exchange(early_, {}));
}

void RunLog::say(Level level, const std::string &text) {
  const std::string line = (level == Level::error     ? "error: "
                            : level == Level::warning ? "warning: "
                                                      : "") +
                           text;
  print(level, line);
  if (level == Level::detail && loudness_ != Loudness::verbose) return;
  if (level == Level::error)
    record(line); // what failed may be the disk: the message must get through
  else
    write(line + '\n');
}

void RunLog::print(Level level, const std::string &line) {
  if (this_rank().is_silent()) return;
  const bool shown = level == Level::error    ? true
                     : level == Level::detail ? loudness_ == Loudness::verbose
                                              : loudness_ != Loudness::quiet;
  if (!shown) return;
  if (make_room_) make_room_();
  (level == Level::error || level == Level::warning ? errors_ : output_) << line << std::endl;
}

void RunLog::record(const std::string &text) noexcept {
  try {
    write(text + '\n');
  } catch (...) { // said on the screen; there is nowhere else to say it
  }
}

void RunLog::write(const std::string &line) {
  if (!opened_) {
    early_ += line;
    return;
  }
  if (!file_.is_open()) return; // failed before
  try {
    file_.write(line);
  } catch (const OutputError &) {
    file_ = OutputFile();
    throw;
  }
}

} // namespace platen::apps
