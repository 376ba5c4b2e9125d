#include "apps/scene/declared.h"

#include <algorithm>

#include "apps/scene/scene.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

std::string section_of(const std::string &path) {
  return path.substr(0, path.rfind('/'));
}

// "a", "a or b", "a, b or c"
std::string alternatives(const std::vector<std::string> &words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 < words.size() ? ", " : " or ") + words[k];
  return text;
}

} // namespace

bool Situation::rate_by_transits() const {
  return program.presses_specimens() && given(scene.loading.wave_transits) && !given(scene.loading.rate);
}

bool has_word(const Parameters &parameters, const std::string &path, const std::vector<std::string> &words) {
  return std::find(words.begin(), words.end(), tidy(parameters.at(path).text)) != words.end();
}

Declared &Declared::only_if(const std::string &path, const std::vector<std::string> &words) {
  if (section_of(path) == section_of(path_)) told(path.substr(path.rfind('/') + 1) + " = " + joined(words));
  entry().idle.push_back([path, words](const Situation &s) {
    return has_word(s.parameters, path, words) ? "" : path + " is not " + alternatives(words);
  });
  return *this;
}

Declared &Declared::unless(const std::string &path, const std::vector<std::string> &words) {
  entry().idle.push_back([path, words](const Situation &s) {
    return has_word(s.parameters, path, words) ? path + " = " + tidy(s.parameters.at(path).text) : "";
  });
  return *this;
}

Declared &Declared::only_if(std::function<bool(const Situation &)> holds, const std::string &otherwise) {
  entry().idle.push_back(
      [holds = std::move(holds), otherwise](const Situation &s) { return holds(s) ? "" : otherwise; });
  return *this;
}

Declared &Declared::needed_if(const std::string &path, const std::vector<std::string> &words) {
  return needed_if([path, words](const Situation &s) {
    return has_word(s.parameters, path, words)
               ? path + " = " + tidy(s.parameters.at(path).text) + " takes it."
               : "";
  });
}

Declared &Declared::needed_if(std::function<std::string(const Situation &)> why) {
  entry().needed.push_back(std::move(why));
  return *this;
}

Declared &Declared::or_word(const std::string &word, const Range &otherwise) {
  Entry &of = entry();
  const std::string standard = of.default_text, unit = of.unit;
  of.read = [read = std::move(of.read), word, otherwise, standard, unit](const std::string &text) {
    if (text.empty() || tidy(text) == word) return read(standard);
    if (!otherwise.holds(to_si(text, unit))) throw ValueError("is out of range");
    read(text);
  };
  of.allowed = word + ", or " + otherwise.text();
  of.default_text = of.text = "";
  return *this;
}

Declared &Declared::says(const std::string &documentation) {
  entry().documentation = documentation;
  return *this;
}

Declared &Declared::told(const std::string &text) {
  std::string &sentence = entry().documentation;
  const auto ends = [&](const std::string &with) {
    return sentence.size() > with.size() &&
           sentence.compare(sentence.size() - with.size(), with.size(), with) == 0;
  };
  const bool open = ends(").") && !ends(")).");
  sentence.erase(sentence.size() - (open ? 2 : 1));
  sentence += (open ? "; " : " (") + text + ").";
  return *this;
}

Declared &Declared::alike(bool first) {
  entry().alike = first ? Entry::Alike::first : Entry::Alike::further;
  return *this;
}

Declared &Declared::member(const std::string &path) {
  entry().members.push_back(path);
  return *this;
}

} // namespace platen::apps
