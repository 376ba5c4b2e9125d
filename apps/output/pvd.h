// Time series of frames for ParaView (.pvd): which file belongs to which time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace platen::apps {

class PvdSeries {
public:
  // A series without frames; nothing is written before the first one.
  explicit PvdSeries(std::filesystem::path path);

  // Adds a frame at `time` (s): an existing file, named relative to the folder of the .pvd, without
  // characters that XML reserves. The .pvd is replaced as a whole, so it lists complete frames only, at any
  // moment. Several files at one time are parts of a frame; a time below the last one throws
  // std::logic_error. Throws OutputError.
  void append(double time, const std::string &file);

  // Continues after the frames up to and including `up_to_time`, as a checkpoint states it; later ones,
  // written before the run was stopped, are dropped from the list (the run writes them again). Throws
  // CheckpointError if the .pvd is damaged or one of its frames is missing. A .pvd that does not exist has no
  // frames.
  void resume(double up_to_time);

private:
  struct Frame {
    double time = 0; // s
    std::string file;
  };
  void write() const;
  std::filesystem::path path_;
  std::vector<Frame> frames_;
};

} // namespace platen::apps
