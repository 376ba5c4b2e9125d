// What a run says: on the screen as loud as the user wants it, and in run.log.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <utility>

#include "apps/output/file.h"

namespace platen::apps {

enum class Loudness { quiet, normal, verbose };

// First lines of run.log.
struct RunHeader {
  std::string version; // text of --version, may have several lines
  std::string command; // command line as typed
  int threads = 0;
};

// One thread only. What is said before open() is kept and stands in the file after its head. info() and
// warning() throw OutputError where the file cannot be written; after the first failure the file is left
// alone, so that the failure itself can still be reported on the screen.
class RunLog {
public:
  explicit RunLog(Loudness loudness);
  RunLog(Loudness loudness, std::ostream &output, std::ostream &errors);

  // A new file, or (append: a resumed run) a new head at the end of the one that is there.
  void open(const std::filesystem::path &path, bool append, const RunHeader &header);

  // Levels: error on every screen; warning and info unless quiet; detail only when verbose. The file holds
  // the same, but info and warnings always. Errors and warnings go to standard error, the rest to standard
  // output.
  template <class... Values>
  void error(fmt::format_string<Values...> text, Values &&...values) {
    say(Level::error, fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  void warning(fmt::format_string<Values...> text, Values &&...values) {
    say(Level::warning, fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  void info(fmt::format_string<Values...> text, Values &&...values) {
    say(Level::info, fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  void detail(fmt::format_string<Values...> text, Values &&...values) {
    say(Level::detail, fmt::format(text, std::forward<Values>(values)...));
  }
  // Into the file alone: what was, or will be, printed elsewhere. Never throws.
  void record(const std::string &text) noexcept;

  Loudness loudness() const { return loudness_; }
  // Called before anything is printed: a progress line makes room.
  void before_printing(std::function<void()> make_room) { make_room_ = std::move(make_room); }

private:
  enum class Level { error, warning, info, detail };
  void say(Level level, const std::string &text);
  void print(Level level, const std::string &text);
  void write(const std::string &line);
  Loudness loudness_;
  std::ostream &output_, &errors_;
  OutputFile file_;
  bool opened_ = false;
  std::string early_; // until the file is opened
  std::function<void()> make_room_;
};

} // namespace platen::apps
