// The functions of the engine library that programs call.
#pragma once

#include "apps/scene/command_line.h"

// Does the work of a program and returns its exit status. A null line and scene: this process is one of
// several ranks, and reads them together with the others.
extern "C" int platen_engine(int argc, char **argv, const platen::apps::Program &program,
                             const platen::apps::CommandLine *line, const platen::apps::Scene *scene);

// `state FOLDER`: lists what the newest checkpoint of an output folder holds; `state FOLDER OTHER`: reports
// the first difference of two. Returns the exit status. Throws std::invalid_argument, CheckpointError.
extern "C" int platen_state(int argc, char **argv);
