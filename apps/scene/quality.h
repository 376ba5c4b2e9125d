// Scene/Quality: one word for the entries that trade accuracy for time.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace platen::apps {

class Parameters;

enum class Quality { custom, fast, standard, reference }; // from `fast` on: coarse to fine

struct QualityWord {
  Quality kind;
  std::string word;
  // Path and the text that stands there where the scene gives none.
  std::vector<std::pair<std::string, std::string>> entries;
  std::string measured; // what it errs by and costs: docs/accuracy.md
};

const std::vector<QualityWord> &quality_words();
const QualityWord &quality(Quality kind);
// A sentence for each word but `custom`.
std::string quality_documentation();

// Whether the scene says itself what the entry of a word would: by that entry, or by its Axial rate in place
// of Wave crossings.
bool overrules_quality(const Parameters &parameters, const std::string &path);
// Gives the entries that the word stands for to those that the scene leaves open.
void supply_quality(Parameters &parameters, Quality kind);
// For the screen, indented: what the word has set, what the scene has set itself, and what was measured; ""
// of `custom`.
std::string text_of(Quality kind, const Parameters &parameters);

} // namespace platen::apps
