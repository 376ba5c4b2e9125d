// Files that are written: every call is checked, and a file appears under its name whole or not at all. On a
// silent rank (apps/scene/rank.h) the calls do nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace platen::apps {

// A file open for writing, without a buffer of its own: what write() has taken a reader sees. Every failure
// throws OutputError with the path and the system's reason ("No space left on device").
class OutputFile {
public:
  enum class Mode { replace, append };
  OutputFile() = default; // no file
  explicit OutputFile(const std::filesystem::path &path, Mode mode = Mode::replace);
  ~OutputFile(); // closes; cannot report, so call close() where it matters
  OutputFile(OutputFile &&other) noexcept;
  OutputFile &operator=(OutputFile &&other) noexcept;

  bool is_open() const { return descriptor_ >= 0; }
  const std::filesystem::path &path() const { return path_; }
  void write(const void *bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  // Throws OutputError where the path leads to another file by now, or to none, or where the file has not the
  // `length` that was written. Pipes and devices may do as they like.
  void require_alone(std::uint64_t length) const;
  void truncate(std::uint64_t length); // and goes on writing there
  bool try_truncate(std::uint64_t length) noexcept;
  void sync(); // returns when the disk has it
  void close();

private:
  [[noreturn]] void fail(const char *what) const;
  int descriptor_ = -1;
  std::filesystem::path path_;
};

// Name under which a file is written until it is whole: in the same folder, with ".part" before the ending,
// so that writers that judge by the ending still do.
std::filesystem::path part_path(const std::filesystem::path &path);
// The name that it then gets: of a part that of the whole file, of any other path that path.
std::filesystem::path whole_path(const std::filesystem::path &part);

// Waits until the disk holds the file `part`, then gives it the name `path`, replacing what had it. Throws
// OutputError.
void make_current(const std::filesystem::path &part, const std::filesystem::path &path);

// Calls write(part_path(path)), which writes that file and closes it, then make_current. Where anything
// throws, the part is removed and a former `path` stays as it was.
void write_aside(const std::filesystem::path &path,
                 const std::function<void(const std::filesystem::path &)> &write);

// The same for text. Throws OutputError.
void write_text_aside(const std::filesystem::path &path, std::string_view text);

// Creates a folder and its parents; nothing happens where it exists. Throws OutputError.
void create_folder(const std::filesystem::path &folder);

} // namespace platen::apps
