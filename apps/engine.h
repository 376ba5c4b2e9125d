// The one function of the engine library that programs call.
#pragma once

#include "apps/scene/command_line.h"

// Does the work of a program and returns its exit status. A null line and scene: this process is one of
// several ranks, and reads them together with the others.
extern "C" int platen_engine(int argc, char **argv, const platen::apps::Program &program,
                             const platen::apps::CommandLine *line, const platen::apps::Scene *scene);
