#include "apps/output/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "apps/output/errors.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

// Calls again what a signal interrupted.
template <class Call>
auto uninterrupted(const Call &call) {
  auto result = call();
  while (result < 0 && errno == EINTR)
    result = call();
  return result;
}

[[noreturn]] void fail_on(const std::filesystem::path &path, const std::string &what, int error) {
  throw OutputError(path.string() + ": " + what + ": " + std::strerror(error));
}

// Waits until the disk holds the entries of a folder (names, renames).
void sync_folder(const std::filesystem::path &folder) {
  const std::filesystem::path path = folder.empty() ? "." : folder;
  const int descriptor =
      uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (descriptor < 0) fail_on(path, "cannot be opened", errno);
  const int result = uninterrupted([&] { return ::fsync(descriptor); });
  const int error = errno;
  ::close(descriptor);
  if (result != 0 && error != EINVAL)
    fail_on(path, "cannot be written", error); // EINVAL: no such thing there
}

} // namespace

OutputFile::OutputFile(const std::filesystem::path &path, Mode mode) : path_(path) {
  if (this_rank().is_silent()) return;
  // Without waiting for the reader of a pipe that stands under the name.
  const int flags =
      O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | (mode == Mode::replace ? O_TRUNC : O_APPEND);
  descriptor_ = uninterrupted([&] { return ::open(path.c_str(), flags, 0666); });
  if (descriptor_ < 0) fail("cannot be opened for writing");
  ::fcntl(descriptor_, F_SETFL, ::fcntl(descriptor_, F_GETFL) & ~O_NONBLOCK);
}

OutputFile::~OutputFile() {
  if (is_open()) ::close(descriptor_);
}

OutputFile::OutputFile(OutputFile &&other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)) {}

OutputFile &OutputFile::operator=(OutputFile &&other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  return *this;
}

void OutputFile::fail(const char *what) const {
  fail_on(path_, what, errno);
}

void OutputFile::write(const void *bytes, std::size_t count) {
  if (this_rank().is_silent()) return;
  const char *next = static_cast<const char *>(bytes);
  while (count > 0) { // a disk that fills up takes a part first
    const ssize_t written = uninterrupted([&] { return ::write(descriptor_, next, count); });
    if (written < 0) fail("cannot be written");
    next += written;
    count -= static_cast<std::size_t>(written);
  }
}

void OutputFile::require_alone(std::uint64_t length) const {
  if (this_rank().is_silent()) return;
  struct stat open {
  }, there{};
  if (::fstat(descriptor_, &open) != 0 || !S_ISREG(open.st_mode)) return;
  const auto refuse = [&](const std::string &what) {
    throw OutputError(path_.string() + ": " + what +
                      " while the run wrote it; put it back as the run wrote it and go on with --resume");
  };
  if (::stat(path_.c_str(), &there) != 0) refuse("has been removed");
  if (there.st_ino != open.st_ino || there.st_dev != open.st_dev) refuse("has been replaced by another file");
  if (static_cast<std::uint64_t>(open.st_size) != length)
    refuse("has been changed by another program (" + std::to_string(open.st_size) + " bytes, " +
           std::to_string(length) + " were written)");
}

bool OutputFile::try_truncate(std::uint64_t new_length) noexcept {
  if (this_rank().is_silent()) return true;
  const auto end = static_cast<off_t>(new_length);
  return uninterrupted([&] { return ::ftruncate(descriptor_, end); }) == 0 &&
         ::lseek(descriptor_, end, SEEK_SET) == end;
}

void OutputFile::truncate(std::uint64_t new_length) {
  if (!try_truncate(new_length)) fail("cannot be shortened");
}

void OutputFile::sync() {
  if (this_rank().is_silent()) return;
  // EINVAL: a pipe or a device, which has nothing to wait for.
  if (uninterrupted([&] { return ::fsync(descriptor_); }) != 0 && errno != EINVAL) fail("cannot be written");
}

void OutputFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  // After EINTR the descriptor is gone all the same.
  if (descriptor >= 0 && ::close(descriptor) != 0 && errno != EINTR) fail("cannot be written");
}

std::filesystem::path part_path(const std::filesystem::path &path) {
  std::filesystem::path part = path;
  return part.replace_filename(path.stem().string() + ".part" + path.extension().string());
}

std::filesystem::path whole_path(const std::filesystem::path &part) {
  std::filesystem::path stem = part.stem();
  if (stem.extension() != ".part") return part;
  std::filesystem::path whole = part;
  return whole.replace_filename(stem.stem().string() + part.extension().string());
}

void make_current(const std::filesystem::path &part, const std::filesystem::path &path) {
  if (this_rank().is_silent()) return;
  {
    OutputFile whole(part, OutputFile::Mode::append);
    whole.sync();
    whole.close();
  }
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) throw OutputError(path.string() + ": cannot be replaced: " + error.message());
  sync_folder(path.parent_path());
}

void write_aside(const std::filesystem::path &path,
                 const std::function<void(const std::filesystem::path &)> &write) {
  if (this_rank().is_silent()) return;
  const std::filesystem::path part = part_path(path);
  try {
    write(part);
    make_current(part, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

void write_text_aside(const std::filesystem::path &path, std::string_view text) {
  write_aside(path, [text](const std::filesystem::path &part) {
    OutputFile file(part);
    file.write(text);
    file.close();
  });
}

void create_folder(const std::filesystem::path &folder) {
  if (this_rank().is_silent()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder)) return;
  throw OutputError(folder.string() + ": cannot be created: " + (error ? error.message() : "it is a file"));
}

} // namespace platen::apps
