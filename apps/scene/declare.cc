#include "apps/scene/declare.h"

#include <algorithm>

#include "apps/scene/scene.h"

namespace platen::apps {
namespace {

// "a", "a or b", "a, b or c"
std::string alternatives(const std::vector<std::string> &words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 < words.size() ? ", " : " or ") + words[k];
  return text;
}

// What is given last counts; nothing given is nothing expected.
void keep_one(std::vector<Expectation> &of, const std::string &key, Expectation expectation) {
  expectation.key = key;
  of.erase(std::remove_if(of.begin(), of.end(), [&](const Expectation &e) { return e.key == key; }),
           of.end());
  if (!expectation.text.empty()) of.push_back(std::move(expectation));
}

} // namespace

bool Situation::rate_by_transits() const {
  return program.presses_specimens() && given(scene.loading.wave_transits) && !given(scene.loading.rate);
}

bool has_word(const Parameters &parameters, const std::string &path, const std::vector<std::string> &words) {
  return std::find(words.begin(), words.end(), tidy(parameters.at(path).text)) != words.end();
}

Declared &Declared::only_if(const std::string &path, const std::vector<std::string> &words) {
  if (section_of(path) == section_of(entry_->path)) remark(last_name(path) + " = " + joined(words));
  entry_->idle.push_back([path, words](const Situation &s) {
    return has_word(s.parameters, path, words) ? "" : path + " is not " + alternatives(words);
  });
  return *this;
}

Declared &Declared::unless(const std::string &path, const std::vector<std::string> &words) {
  entry_->idle.push_back([path, words](const Situation &s) {
    return has_word(s.parameters, path, words) ? path + " = " + tidy(s.parameters.at(path).text) : "";
  });
  return *this;
}

Declared &Declared::only_if(std::function<bool(const Situation &)> holds, const std::string &otherwise) {
  entry_->idle.push_back(
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
  entry_->needed.push_back(std::move(why));
  return *this;
}

Declared &Declared::or_word(const std::string &word, const Range &otherwise) {
  Entry &of = *entry_;
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

Declared &Declared::documented(const std::string &documentation) {
  entry_->documentation = documentation;
  return *this;
}

Declared &Declared::remark(const std::string &text) {
  std::string &sentence = entry_->documentation;
  const auto ends = [&](const std::string &with) {
    return sentence.size() > with.size() &&
           sentence.compare(sentence.size() - with.size(), with.size(), with) == 0;
  };
  const bool open = ends(").") && !ends(")).");
  sentence.erase(sentence.size() - (open ? 2 : 1));
  sentence += (open ? "; " : " (") + text + ").";
  return *this;
}

Declared &Declared::member(const std::string &path) {
  entry_->members.push_back(path);
  return *this;
}

Declared &Declared::of_words(const std::vector<std::string> &words) {
  entry_->words = words;
  return *this;
}

bool Section::sets(const std::string &member) const {
  return std::any_of(parameters_.entries().begin(), parameters_.entries().end(), [&](const Entry &entry) {
    return section_of(entry.path) == name_ &&
           std::find(entry.members.begin(), entry.members.end(), member) != entry.members.end();
  });
}

Declared Section::declare(const std::string &key, const std::string &default_text, const std::string &unit,
                          const std::string &allowed, const std::string &documentation,
                          std::function<void(const std::string &)> read) {
  Entry entry;
  entry.path = name_ + "/" + key;
  entry.default_text = default_text;
  entry.unit = unit;
  entry.allowed = allowed;
  entry.documentation = documentation;
  entry.read = std::move(read);
  const bool further = join_ && parameters_.find(entry.path) != nullptr;
  Declared declared = further ? parameters_.join(std::move(entry)) : parameters_.declare(std::move(entry));
  for (const Say &said : of_each_)
    said(declared);
  return declared;
}

Declared Section::entry(const std::string &key, double &to, const std::string &si_unit, const Range &range,
                        const std::string &documentation) {
  const Quantity quantity(name_ + "/" + key, si_unit, range);
  return declare(key, shortest_text(to), si_unit, quantity.allowed(), documentation,
                 [&to, quantity](const std::string &text) { to = quantity.read(text); });
}

Declared Section::entry(const std::string &key, std::vector<double> &to, const std::string &si_unit,
                        const Range &range, const std::string &documentation) {
  const Quantity quantity(name_ + "/" + key, si_unit, range);
  return declare(key, "", si_unit, "numbers with commas between them, each " + quantity.allowed(),
                 documentation, [&to, quantity](const std::string &text) { to = read_list(text, quantity); });
}

Declared Section::entry(const std::string &key, bool &to, const std::string &documentation) {
  return declare(key, to ? "on" : "off", "", "on, off", documentation,
                 [&to](const std::string &text) { to = read_flag(text); })
      .of_words({"on", "off"});
}

Declared Section::text(const std::string &key, std::string &to, const std::string &documentation) {
  const auto read = [&to](const std::string &given) { to = given; };
  const Declared declared = declare(key, to, "", "", documentation, read);
  parameters_.declared(name_ + "/" + key).is_text = true;
  return declared;
}

Declared Section::file(const std::string &key, std::string &to, const std::string &documentation) {
  const auto read = [&to](const std::string &given) { to = given; };
  const Declared declared = declare(key, to, "", "path of a file", documentation, read);
  parameters_.declared(name_ + "/" + key).is_file = true;
  return declared;
}

Declared Section::entry(const std::string &key, Interval &to, const std::string &documentation) {
  return declare(key, text_of(to), "", "steps (a whole number), or a time with its unit; 0 or more",
                 documentation, [&to](const std::string &text) { to = read_interval(text); });
}

Declared Section::entry(const std::string &key, Gap &to, const std::string &documentation) {
  return declare(key, text_of(to), "", gap_allowed, documentation,
                 [&to](const std::string &text) { to = read_gap(text); });
}

Declared Section::stiffness(const std::string &key, Stiffness &to, bool bulk_allowed,
                            const std::string &documentation) {
  return declare(key, text_of(to), "", stiffness_allowed(bulk_allowed), documentation,
                 [&to, bulk_allowed](const std::string &text) { to = read_stiffness(text, bulk_allowed); });
}

Declared Section::expectation(const std::string &key, std::vector<Expectation> &to, const std::string &unit,
                              const std::string &documentation) {
  const Quantity quantity(name_ + "/" + key, unit, any_number());
  return declare(key, "", unit, "\"low ... high\"", documentation,
                 [&to, key, unit, quantity](const std::string &text) {
                   keep_one(to, key, read_expectation(text, unit, quantity));
                 });
}

Declared Section::expected_words(const std::string &key, std::vector<Expectation> &to,
                                 const std::vector<std::string> &words, const std::string &documentation) {
  return declare(
      key, "", "", "with commas between them, any of " + joined(words), documentation,
      [&to, key, words](const std::string &text) { keep_one(to, key, read_expected_words(text, words)); });
}

} // namespace platen::apps
