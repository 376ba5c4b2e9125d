// What can go wrong with files: OutputError (exit status 4) comes from apps/scene/errors.h, the kinds of bad
// input (exit status 2) that only the files of a run know are here.
#pragma once

#include "apps/scene/errors.h"

namespace platen::apps {

// A checkpoint, or a file that it goes on with, is missing, damaged or of another scene. The text names the
// file and what is wrong with it.
class CheckpointError : public InputError {
public:
  using InputError::InputError;
};

// The output folder cannot be used. The text names it and says what to do.
class FolderError : public InputError {
public:
  using InputError::InputError;
};

} // namespace platen::apps
