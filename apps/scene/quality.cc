#include "apps/scene/quality.h"

#include <algorithm>

#include "apps/scene/parameters.h"

namespace platen::apps {
const std::vector<QualityWord> &quality_words() {
  static const std::vector<QualityWord> all{
      {Quality::custom, "custom", {}, ""},
      {Quality::fast,
       "fast",
       {{"Integration/Safety", "0.95"}, {"Loading/Wave crossings", "30"}, {"Platens/Steps per solve", "50"}},
       "measured against reference, on 728 and on 5018 spheres: strength +0.3 +- 0.6 and +3.8 +- 1.3 %, "
       "Young's modulus +0.2 +- 0.3 and +0.1 +- 0.2 %, a ninth of its steps (docs/accuracy.md)"},
      {Quality::standard,
       "standard",
       {{"Integration/Safety", "0.8"}, {"Loading/Wave crossings", "60"}, {"Platens/Steps per solve", "20"}},
       "measured against reference, on 728 and on 5018 spheres: strength -0.4 +- 1.8 and +1.6 +- 0.9 %, "
       "Young's modulus 0.02 +- 0.03 and 0.1 +- 0.1 %, a quarter of its steps (docs/accuracy.md)"},
      {Quality::reference,
       "reference",
       {{"Integration/Safety", "0.4"}, {"Loading/Wave crossings", "120"}, {"Platens/Steps per solve", "5"}},
       "what the others are measured against; seeds of 728 and of 5018 spheres scatter by 7 and 2 % in "
       "strength, 4 and 1 % in Young's modulus (docs/accuracy.md)"}};
  return all;
}

const QualityWord &quality(Quality kind) {
  return *std::find_if(quality_words().begin(), quality_words().end(),
                       [&](const QualityWord &one) { return one.kind == kind; });
}

std::string quality_documentation() {
  std::string text;
  for (const QualityWord &one : quality_words()) {
    if (one.entries.empty()) continue;
    text += (text.empty() ? "" : "; ") + one.word + ":";
    for (const auto &[path, value] : one.entries)
      text += (&path == &one.entries.front().first ? " " : ", ") + path + " = " + value;
  }
  return text + ".";
}

bool overrules_quality(const Parameters &parameters, const std::string &path) {
  return !parameters.at(path).origin.file.empty() ||
         (path == "Loading/Wave crossings" && !parameters.at("Loading/Axial rate").text.empty());
}

void supply_quality(Parameters &parameters, Quality kind) {
  for (const auto &[path, value] : quality(kind).entries)
    if (!overrules_quality(parameters, path)) parameters.supply(path, value);
}

std::string text_of(Quality kind, const Parameters &parameters) {
  const QualityWord &word = quality(kind);
  if (word.entries.empty()) return "";
  std::string set, own;
  for (const auto &[path, value] : word.entries) {
    const bool overruled = overrules_quality(parameters, path);
    std::string &to = overruled ? own : set;
    to += (to.empty() ? "" : ", ") + (overruled ? path : path + " = " + value);
  }
  return "  quality " + word.word + ": " + (set.empty() ? "nothing left open" : set) +
         (own.empty() ? "" : "; the scene's own: " + own) + "\n" +
         (word.measured.empty() ? "" : "    " + word.measured + "\n");
}

} // namespace platen::apps
