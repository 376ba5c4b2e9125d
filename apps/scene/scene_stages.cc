#include "apps/scene/scene_stages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/scene/parameters.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

using coupling::SideControl;
using coupling::SideGroup;
using coupling::StageUntil;
using Mode = SideControl::Mode;
using Reached = coupling::Until::Reached;

const std::vector<std::pair<std::string, Mode>> &words_of_modes() {
  static const std::vector<std::pair<std::string, Mode>> words{
      {"rate", Mode::rate},
      {"unload", Mode::rate},
      {"stress", Mode::stress},
      {"share of", Mode::fraction},
      {"pressure", Mode::pressure},
      {"hold", Mode::hold},
      {"free", Mode::free},
      {"circumferential rate", Mode::circumferential},
      {"cmod rate", Mode::mouth_opening}};
  return words;
}

// "strain change" before "strain".
constexpr std::array all_ends{Reached::strain_change,
                              Reached::strain,
                              Reached::stress,
                              Reached::fraction_of_peak,
                              Reached::fraction_of_start,
                              Reached::circumferential_strain,
                              Reached::mouth_opening,
                              Reached::time,
                              Reached::settled};

// Of the value of an end.
const char *unit_of(Reached what) {
  return what == Reached::stress          ? "Pa"
         : what == Reached::time          ? "s"
         : what == Reached::mouth_opening ? "m"
                                          : "1";
}

// Takes a word and the blank after it from the front of a text.
bool take(std::string &text, const std::string &word) {
  if (text.compare(0, word.size(), word) != 0) return false;
  if (text.size() > word.size() && text[word.size()] != ' ') return false;
  text = text.size() > word.size() ? text.substr(word.size() + 1) : "";
  return true;
}

std::optional<SideGroup> take_side(std::string &text) {
  std::optional<SideGroup> found; // the longest: "Lateral x" before "Lateral"
  for (const SideGroup group : coupling::all_side_groups) {
    std::string rest = text;
    if (take(rest, key_of(group)) && (!found || key_of(group).size() > key_of(*found).size())) found = group;
  }
  if (found) take(text, key_of(*found));
  return found;
}

[[noreturn]] void fail_side(const std::string &text) {
  std::vector<std::string> sides;
  for (const SideGroup group : coupling::all_side_groups)
    sides.push_back(key_of(group));
  throw ValueError("names no side in \"" + text + "\": " + joined(sides) + " are sides");
}

double value_of(const std::string &text, const std::string &unit) {
  if (text.empty()) throw ValueError("has no value");
  const NumberWithUnit number = split_number(text);
  const double value = to_si(number, unit);
  const Quantity quantity("", unit, at_least(0));
  if (!quantity.holds(std::abs(value)))
    throw ValueError("has a value out of range, " + quantity.allowed() + (unit == "1" ? "" : " " + unit));
  quantity.require_meant(number);
  return value;
}

// "0.05 1/s", "5 %/s"; a bare number is per second.
double strain_rate_of(const std::string &text) {
  std::string number = text;
  for (const char *ending : {" 1/s", " /s", "/s"}) {
    const std::size_t length = std::string(ending).size();
    if (number.size() <= length || number.compare(number.size() - length, length, ending) != 0) continue;
    number.resize(number.size() - length);
    break;
  }
  return value_of(number, "1");
}

} // namespace

bool StageSection::given() const {
  return ramp > 0 || hold > 0 || !until.empty() ||
         std::any_of(controls.begin(), controls.end(),
                     [](const auto &control) { return control.has_value(); });
}

std::string section_of_stage(std::size_t number) {
  return "Loading/Stage " + std::to_string(number);
}

std::string key_of(SideGroup group) {
  std::string key = coupling::words_of(group);
  key[0] = static_cast<char>(key[0] - 'a' + 'A');
  return key;
}

std::optional<SideControl> read_control(const std::string &text) {
  std::string rest = tidy(text);
  if (rest.empty()) return std::nullopt;
  for (const auto &[word, kind] : words_of_modes()) {
    if (!take(rest, word)) continue;
    SideControl control;
    control.mode = kind;
    switch (kind) {
      case Mode::rate:
        control.back = word == "unload";
        if (!rest.empty()) control.value = value_of(rest, "m/s");
        if (control.back && control.value <= 0) throw ValueError("unloads at no speed");
        return control;
      case Mode::stress:
      case Mode::pressure:
        control.value = value_of(rest, "Pa");
        return control;
      case Mode::circumferential:
        control.value = strain_rate_of(rest);
        return control;
      case Mode::mouth_opening:
        control.value = value_of(rest, "m/s");
        return control;
      case Mode::fraction: {
        const std::optional<SideGroup> of = take_side(rest);
        if (!of) fail_side(rest);
        control.of = *of;
        control.value = value_of(rest, "1");
        return control;
      }
      default:
        if (!rest.empty()) throw ValueError("has \"" + rest + "\" after " + word);
        return control;
    }
  }
  std::vector<std::string> words;
  for (const auto &one : words_of_modes())
    words.push_back(one.first);
  const std::string first = rest.substr(0, rest.find(' ')), nearest = nearest_word(first, words);
  throw ValueError("asks nothing that is known." +
                   (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?"));
}

std::vector<StageUntil> read_until(const std::string &text) {
  std::vector<StageUntil> ends;
  std::string all = tidy(text);
  while (!all.empty()) {
    const std::size_t comma = std::min(all.find(','), all.size());
    std::string item = tidy(all.substr(0, comma));
    all = comma < all.size() ? tidy(all.substr(comma + 1)) : "";
    StageUntil end;
    if (const std::optional<SideGroup> of = take_side(item)) end.of = *of;
    const auto found = std::find_if(all_ends.begin(), all_ends.end(),
                                    [&](Reached what) { return take(item, coupling::name_of(what)); });
    if (found == all_ends.end()) throw ValueError("has an end that is not known: \"" + item + "\"");
    end.what = *found;
    if (end.what == Reached::settled) {
      if (!item.empty()) throw ValueError("has \"" + item + "\" after settled");
    } else {
      end.value = value_of(item, unit_of(end.what));
    }
    ends.push_back(end);
  }
  return ends;
}

std::vector<coupling::StageSettings> stages_of(const std::array<StageSection, most_stages> &sections) {
  std::vector<coupling::StageSettings> stages;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const StageSection &section = sections[k];
    if (!section.given()) continue;
    coupling::StageSettings stage;
    stage.name = "stage " + std::to_string(k + 1);
    for (const SideGroup group : coupling::all_side_groups) {
      std::optional<SideControl> control = section.controls.at(static_cast<std::size_t>(group));
      if (control) control->side = group, stage.controls.push_back(*control);
    }
    stage.ramp = section.ramp, stage.hold = section.hold, stage.until = section.until;
    stages.push_back(stage);
  }
  return stages;
}

} // namespace platen::apps
