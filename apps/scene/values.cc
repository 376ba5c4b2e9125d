#include "apps/scene/values.h"

#include <algorithm>
#include <cmath>

namespace platen::apps {
namespace {

// Of bonds, over the smaller radius: a second neighbour in a dense packing begins at .83.
constexpr double most_gap = 1;
// A stiffness over that of bonds, or of grains, within which a time step still follows both.
const Range multiples = between(1e-6, 1e6);
constexpr double largest_whole_number = 9007199254740992.0; // 2^53: beyond it doubles skip whole numbers

} // namespace

double read_quantity(const std::string &text, const std::string &si_unit, const Range &range) {
  return Quantity("", si_unit, range).read(text);
}

long read_integer(const std::string &text, const Range &range) {
  const NumberWithUnit number = split_number(text);
  if (!number.unit.empty())
    throw ValueError("is not a whole number: it is followed by \"" + number.unit + "\"");
  if (number.value != std::floor(number.value)) throw ValueError("is not a whole number");
  if (!range.holds(number.value)) throw ValueError("is out of range");
  if (std::abs(number.value) > largest_whole_number) throw ValueError("is too large for a whole number");
  return static_cast<long>(number.value);
}

bool read_flag(const std::string &text) {
  if (text == "on" || text == "true" || text == "yes") return true;
  if (text == "off" || text == "false" || text == "no") return false;
  throw ValueError("is neither on nor off");
}

Interval read_interval(const std::string &text) {
  const NumberWithUnit number = split_number(text);
  if (number.value < 0) throw ValueError("is negative");
  const bool time = !number.unit.empty();
  const double value =
      time ? read_quantity(text, "s", at_least(0)) : static_cast<double>(read_integer(text, at_least(0)));
  if (value == 0) return {};
  return {time ? Interval::Kind::time : Interval::Kind::steps, value};
}

Gap read_gap(const std::string &text) {
  const NumberWithUnit number = split_number(text);
  const bool relative = number.unit == "R_min";
  if (number.value < 0) throw ValueError("is negative");
  if (relative && number.value > most_gap)
    throw ValueError("reaches past the neighbours: spheres as far apart have others between them");
  if (relative) return {true, number.value};
  const double length = to_si(number, "m");
  if (!Quantity("", "m", any_number()).holds(length)) throw ValueError("is out of range");
  return {false, length};
}

Stiffness read_stiffness(const std::string &text, bool bulk_allowed) {
  const NumberWithUnit number = split_number(text);
  const bool bulk = bulk_allowed && number.unit == "bulk";
  if (!bulk && !number.unit.empty()) return {Stiffness::Kind::absolute, read_quantity(text, "N/m", above(0))};
  if (!multiples.holds(number.value)) throw ValueError("is out of range");
  return {bulk ? Stiffness::Kind::of_bulk : Stiffness::Kind::of_bond, number.value};
}

std::vector<double> read_list(const std::string &text, const Quantity &each) {
  return read_items<double>(text, [&](const std::string &item) { return each.read(item); });
}

Expectation read_expectation(const std::string &text, const std::string &si_unit, const Quantity &each) {
  Expectation expectation;
  expectation.text = text;
  if (text.empty()) return expectation;
  const std::size_t dots = text.find("...");
  if (dots == std::string::npos) throw ValueError("is no range: \"low ... high\" is");
  const std::string low = tidy(text.substr(0, dots)), high = tidy(text.substr(dots + 3));
  if (low.empty() && high.empty()) throw ValueError("is no range: neither low nor high is given");
  const auto read = [&](const std::string &bound, double &to) {
    if (bound.empty()) return;
    const NumberWithUnit number = split_number(bound);
    to = to_si(number, si_unit);
    each.require_meant(number);
    if (expectation.unit.empty() && !number.unit.empty())
      expectation.unit = number.unit, expectation.of_unit = to_si({1, number.unit}, si_unit);
  };
  read(low, expectation.low);
  read(high, expectation.high);
  if (expectation.low > expectation.high) throw ValueError("is an empty range: low is above high");
  return expectation;
}

Expectation read_expected_words(const std::string &text, const std::vector<std::string> &words) {
  Expectation expectation;
  expectation.text = text;
  expectation.words =
      read_items<std::string>(text, [&](const std::string &item) { return words[read_word(item, words)]; });
  return expectation;
}

std::size_t read_word(const std::string &text, const std::vector<std::string> &words) {
  const std::string word = tidy(text);
  const auto position = std::find(words.begin(), words.end(), word);
  if (position == words.end()) throw ValueError("is not known." + did_you_mean(word, words));
  return static_cast<std::size_t>(position - words.begin());
}

const char *const gap_allowed = "\"0.05 R_min\", 0 ... 1 of it, or a length (m) below the radius";

std::string stiffness_allowed(bool bulk_allowed) {
  return "a multiple of the bond's, " + multiples.text() + ", or with unit \"4e5 N/m\"" +
         (bulk_allowed ? ", \"0.01 bulk\"" : "") + "; > 0";
}

std::string text_of(const Interval &interval) {
  if (interval.kind == Interval::Kind::none) return "0";
  return shortest_text(interval.value) + (interval.kind == Interval::Kind::time ? " s" : "");
}

std::string text_of(const Gap &gap) {
  return shortest_text(gap.value) + (gap.relative ? " R_min" : " m");
}

std::string text_of(const Stiffness &stiffness) {
  const char *unit = stiffness.kind == Stiffness::Kind::absolute  ? " N/m"
                     : stiffness.kind == Stiffness::Kind::of_bulk ? " bulk"
                                                                  : "";
  return shortest_text(stiffness.value) + unit;
}

std::vector<std::string> read_assignments(const std::string &text, bool may_clear) {
  return read_items<std::string>(text, [may_clear](const std::string &item) {
    const std::size_t sign = item.find('=');
    if (sign == std::string::npos) throw ValueError("sets nothing: \"Section/Key = value\" does");
    const std::string path = tidy(item.substr(0, sign)), value = tidy(item.substr(sign + 1));
    if (path.find('/') == std::string::npos) throw ValueError("names no entry: \"Section/Key = value\" does");
    if (value.empty() && !may_clear) throw ValueError("has no value");
    return value.empty() ? path + " =" : path + " = " + value;
  });
}

} // namespace platen::apps
