// Options of the benchmarks as lists, so that one file compiles the parser for all of them.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace platen::bench {

struct Argument {
  const char *name;                                                               // "--steps"
  std::variant<int *, std::vector<int> *, double *, bool *, std::string *> value; // a bool is a switch
  const char *meaning;
  double low = 0, high = 0;            // of numbers, both allowed
  std::vector<std::string> words = {}; // that a text may be; none: any
  bool is_file = false;                // of a text: it names a file that is there
};

// Ends the program after --help, and with an error where an argument is not as its list says.
void read_arguments(int argc, char **argv, const char *title, const std::vector<Argument> &arguments);

} // namespace platen::bench
