// The faces of platens by name: which entries of section Platens a word stands for, and whose figures they
// are.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/scene/scene_loading.h"

namespace platen::apps {

class Parameters;

struct StudySurface { // a word, or a coefficient of friction
  SurfaceKind kind = SurfaceKind::custom;
  double friction = not_given; // static and dynamic; not given: what the word says
};

struct Surface {
  SurfaceKind kind;
  std::string word;
  // Key within Platens and the text that stands there where the scene gives none.
  std::vector<std::pair<std::string, std::string>> entries;
  bool of_one_side; // friction alone: one platen may have it and the other not
  std::string source;
};

// All but `common`, which stands for another one.
const std::vector<Surface> &surfaces();
const Surface &surface(SurfaceKind kind);
// As they stand in a scene; those of one side begin with "common".
std::vector<std::pair<std::string, SurfaceKind>> surface_words(bool of_one_side);
// A line for each word: its entries and their source.
std::string surface_documentation();

// "dry steel, 0.1": words of Platens/Surface, or coefficients of friction; "" is none. Throws ValueError.
std::vector<StudySurface> read_surfaces(const std::string &text);
std::string text_of(const StudySurface &surface);

// For the screen, a line each, indented: what the platens are, with friction as used; what the words say.
std::string text_of(const Platens &platens);

// Gives the entries that the words of the scene stand for to those that nobody has set. A platen takes, first
// found: its own figure, that of its own word, the common figure, that of the common word.
void supply_surfaces(Parameters &parameters, const Platens &platens);

} // namespace platen::apps
