// Texts of a scene file to values and back: ranges, words, and the kinds of number that this format knows.
// Every function throws ValueError for a text that is no such value.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "apps/scene/quantities.h"
#include "apps/scene/quantity.h"
#include "apps/scene/texts.h"
#include "base/range.h"

namespace platen::apps {

// What stands between commas, each piece read by read(piece); "" is no piece.
template <class Value, class Read>
std::vector<Value> read_items(const std::string &text, const Read &read) {
  std::vector<Value> values;
  if (text.empty()) return values;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t comma = std::min(text.find(',', first), text.size());
    const std::string item = tidy(text.substr(first, comma - first));
    try {
      if (item.empty()) throw ValueError("is empty");
      values.push_back(read(item));
    } catch (const ValueError &error) {
      throw ValueError("holds an item, \"" + item + "\", that " + error.what());
    }
    first = comma + 1;
  }
  return values;
}

// A number with its unit, inside the range and what is physical; "" is NaN.
double read_quantity(const std::string &text, const std::string &si_unit, const Range &range);
// A whole number without a unit.
long read_integer(const std::string &text, const Range &range);
// on / off, true / false, yes / no.
bool read_flag(const std::string &text);
// "200" steps, "0.1 ms", "10 min"; 0 is none.
Interval read_interval(const std::string &text);
// "0.05 R_min", of less than a radius, or a length; not negative.
Gap read_gap(const std::string &text);
// "2" of the bond's, "4e5 N/m", and, where it is allowed, "0.01 bulk".
Stiffness read_stiffness(const std::string &text, bool bulk_allowed);
// "1 GPa, 2 GPa"; "" is no number.
std::vector<double> read_list(const std::string &text, const Quantity &each);
// "35 MPa ... 50 MPa", "... 0.1", "0.9 ..."; fills low and high, and the unit that is written there first.
Expectation read_expectation(const std::string &text, const std::string &si_unit, const Quantity &each);
// "cones, shear plane": any of `words`.
Expectation read_expected_words(const std::string &text, const std::vector<std::string> &words);
// "Effects/Rotation = off, Platens/Degree = 2": path and value of each, tidied; "" is none. `may_clear`:
// "Specimen/Radius =" takes the value of an entry away.
std::vector<std::string> read_assignments(const std::string &text, bool may_clear);
inline std::vector<std::string> read_assignments(const std::string &text) {
  return read_assignments(text, false);
}
// The place of a word in `words`.
std::size_t read_word(const std::string &text, const std::vector<std::string> &words);

// What read_gap and read_stiffness take.
extern const char *const gap_allowed;
std::string stiffness_allowed(bool bulk_allowed);

std::string text_of(const Interval &interval);
std::string text_of(const Gap &gap);
std::string text_of(const Stiffness &stiffness);

} // namespace platen::apps
