#include "apps/scene/file_text.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "apps/scene/scene_files.h"

namespace platen::apps {

std::string read_text(const std::string &path) {
  const auto fail = [&](const std::string &reason) {
    throw EntryError(path + ": error: cannot be read: " + reason, {path, 0, 0, 0}, "");
  };
  constexpr std::size_t largest = 4u << 20; // bytes; a scene is a few thousand, so this is some other file
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail("it is a folder.");
  if (is_pipe_or_device(path)) fail("it is a pipe or a device, no file.");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(std::string(std::strerror(errno)) + ".");
  std::vector<char> buffer(largest + 1);
  file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  const std::size_t length = static_cast<std::size_t>(file.gcount());
  if (file.bad()) fail(std::string(std::strerror(errno)) + ".");
  if (length > largest) fail("it is larger than 4 MB, so it is no scene.");
  std::string text(buffer.data(), length);
  if (text.find('\0') != std::string::npos) fail("it holds a zero byte, so it is no text file.");
  return without_byte_order_mark(text);
}

std::string without_byte_order_mark(const std::string &text) {
  return text.compare(0, 3, "\xef\xbb\xbf") == 0 ? text.substr(3) : text;
}

void read_scene_file(const std::string &path, Parameters &parameters) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".prm" && ending != ".json")
    throw EntryError(
        path + ": error: is no scene file by its name. Allowed: names that end in .prm or .json.",
        {path, 0, 0, 0}, "");
  parameters.add_source(path);
  const std::string text = read_text(path);
  if (ending == ".json")
    read_json_text(text, path, parameters);
  else
    read_prm_text(text, path, parameters);
}

} // namespace platen::apps
