// What a declared entry depends on: said once, where it is declared. From it follow the notes on entries that
// have no effect, and the refusals of those that are missing.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "apps/scene/parameters.h"
#include "apps/scene/program.h"

namespace platen::apps {

struct Scene;

// What is checked when a scene has been read.
struct Situation {
  const Scene &scene;
  const Parameters &parameters;
  const Program &program;

  operator const Scene &() const { return scene; }
  bool loads() const { return program.presses != Presses::nothing; }
  bool rate_by_transits() const; // Loading/Wave crossings sets the rate
  // The program gives the entry to each of its runs, from a list of its own.
  bool given_by_program(const std::string &path) const {
    return program.gives != nullptr && program.gives(scene, parameters, path);
  }
  // A test of the program needs this part, though the scene does not ask for it.
  bool used_by_program(const std::string &part) const {
    return program.uses != nullptr && program.uses(scene, part);
  }
};

inline bool given(double value) {
  return !std::isnan(value);
}

class Declared {
public:
  Declared(Parameters &parameters, std::string path) : parameters_(parameters), path_(std::move(path)) {}

  // It has an effect only where another entry has one of these words; within a section the documentation says
  // so too.
  Declared &only_if(const std::string &path, const std::vector<std::string> &words);
  // It has none where another entry has one of these words.
  Declared &unless(const std::string &path, const std::vector<std::string> &words);
  Declared &only_if(std::function<bool(const Situation &)> holds, const std::string &otherwise);
  // It must be given where another entry has one of these words.
  Declared &needed_if(const std::string &path, const std::vector<std::string> &words);
  // It must be given where `why`, a sentence, is not "".
  Declared &needed_if(std::function<std::string(const Situation &)> why);
  // A word stands for the number that it has beforehand, numbers have to be of the range; where nothing is
  // given that number holds too, but there is no default.
  Declared &or_word(const std::string &word, const Range &otherwise);
  // Takes the place of the documentation.
  Declared &says(const std::string &documentation);
  // Ends the documentation with " (text).".
  Declared &told(const std::string &text);
  // It is of the first of several sections alike, or of a further one.
  Declared &alike(bool first);
  // The member of the library's struct that it sets.
  Declared &member(const std::string &path); // "loading.ramp"

private:
  Entry &entry() const { return parameters_.declared(path_); }

  Parameters &parameters_;
  std::string path_;
};

// Whether an entry has one of these words.
bool has_word(const Parameters &parameters, const std::string &path, const std::vector<std::string> &words);

} // namespace platen::apps
