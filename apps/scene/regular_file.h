// Files that are read: a pipe without a writer, or a device, would keep a program waiting for ever.
#pragma once

#include <filesystem>
#include <fstream>

namespace platen::apps {

// What is there and neither a file nor a folder; links are followed.
inline bool is_pipe_or_device(const std::filesystem::path &path) {
  std::error_code none;
  const std::filesystem::file_status there = std::filesystem::status(path, none);
  return std::filesystem::exists(there) && !std::filesystem::is_regular_file(there) &&
         !std::filesystem::is_directory(there);
}

// A stream that has failed where `path` is no file that can be read; else one of its bytes.
inline std::ifstream open_file(const std::filesystem::path &path) {
  std::error_code none;
  std::ifstream file;
  if (is_pipe_or_device(path) || std::filesystem::is_directory(path, none))
    file.setstate(std::ios::failbit);
  else
    file.open(path, std::ios::binary);
  return file;
}

} // namespace platen::apps
