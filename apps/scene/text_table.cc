#include "apps/scene/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>

#include "apps/output/numbers.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

constexpr const char *units_allowed = "m, cm, mm, um";

// The power of ten that a unit of length is, in m.
std::optional<int> power_of(std::string_view unit) {
  constexpr std::pair<std::string_view, int> units[] = {
      {"m", 0}, {"cm", -2}, {"mm", -3}, {"um", -6}, {"\xc2\xb5m", -6}};
  for (const auto &[name, power] : units)
    if (name == unit) return power;
  return std::nullopt;
}

std::string lower(std::string_view text) {
  std::string low = with_micro_sign(std::string(text));
  for (char &c : low)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return low;
}

// "x [mm]", "x (mm)" and "x_mm" as name and unit; "" where there is no unit.
struct Label {
  std::string name, unit;
};

Label in_brackets_or_whole(const std::string &text) {
  const auto open = text.find_first_of("[(");
  if (open == std::string::npos || open == 0) return {text, ""};
  const auto close = std::min(text.find_first_of("])", open), text.size());
  return {std::string(trimmed(text.substr(0, open))),
          std::string(trimmed(text.substr(open + 1, close - open - 1)))};
}

Label after_dash(const std::string &text) {
  const auto dash = text.rfind('_');
  if (dash == std::string::npos) return {text, ""};
  return {text.substr(0, dash), text.substr(dash + 1)};
}

char separator_of(std::string_view header) {
  for (const char separator : {';', '\t', ','})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

void split(std::string_view line, char separator, std::vector<std::string_view> &cells) {
  cells.clear();
  constexpr std::string_view blanks = " \t";
  for (std::size_t first = 0; first <= line.size();) {
    if (separator == ' ') first = std::min(line.find_first_not_of(blanks, first), line.size());
    const std::size_t end = separator == ' ' ? std::min(line.find_first_of(blanks, first), line.size())
                                             : std::min(line.find(separator, first), line.size());
    if (separator != ' ' || end > first) cells.push_back(trimmed(line.substr(first, end - first)));
    first = end + 1;
  }
}

// What parts the columns of a row of so many numbers. A comma with blanks about is a decimal sign.
char separator_of_row(std::string_view row, std::size_t columns, std::vector<std::string_view> &cells) {
  const char seen = separator_of(row);
  if (seen != ',') return seen;
  split(row, ',', cells);
  const auto has_blanks = [](std::string_view cell) { return cell.find_first_of(" \t") != cell.npos; };
  return cells.size() >= columns && std::none_of(cells.begin(), cells.end(), has_blanks) ? ',' : ' ';
}

// Blanks part names, but not a name from its unit in brackets: "x [mm] y [mm]".
void join_units(std::vector<std::string_view> &cells) {
  std::vector<std::string_view> joined;
  for (const std::string_view cell : cells) {
    if (joined.empty() || (cell.front() != '[' && cell.front() != '('))
      joined.push_back(cell);
    else
      joined.back() = {joined.back().data(),
                       static_cast<std::size_t>(cell.data() + cell.size() - joined.back().data())};
  }
  cells = joined;
}

std::string_view unquoted(std::string_view cell) {
  const bool quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
  return quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

} // namespace

void TextPlace::fail(const std::string &what) const {
  const std::string odd = text_of_odd_character(text), at = line > 0 ? fmt::format(":{}", line) : "";
  throw InputError(
      fmt::format("{}{}: error: {}{}", file, at, what, odd.empty() ? "" : "; the line holds " + odd));
}

std::string cut_short(std::string_view text) {
  constexpr std::size_t shown = 60;
  return std::string(text.substr(0, shown));
}

void read_lines(const std::filesystem::path &path, TextPlace &place,
                const std::function<bool(std::string_view)> &take) {
  place.file = path.string();
  std::ifstream stream = open_file(path);
  if (!stream) throw InputError(place.file + ": error: cannot be read");
  for (std::string whole; std::getline(stream, whole);) {
    if (!whole.empty() && whole.back() == '\r') whole.pop_back();
    if (place.line == 0 && whole.compare(0, 3, "\xef\xbb\xbf") == 0) whole.erase(0, 3);
    for (std::size_t first = 0; first <= whole.size();) {
      const std::size_t end = std::min(whole.find('\r', first), whole.size());
      ++place.line;
      place.text = std::string_view(whole).substr(first, end - first);
      if (!take(place.text)) return;
      first = end + 1;
    }
  }
  place.text = {};
  if (stream.bad()) throw InputError(place.file + ": error: cannot be read to its end");
}

TextTable::TextTable(const KnownColumns &known) : known_(known) {
  std::size_t columns = 0;
  for (const KnownColumns::Word &one : known.words)
    columns = std::max(columns, one.column + 1);
  cell_.resize(columns), factor_.resize(columns), value_.resize(columns), exponent_.resize(columns);
}

void TextTable::take_header(std::string_view line, const TextPlace &place) {
  separator_ = separator_of(line), whence_ = "the header", further_ = 0, states_units_ = true;
  split(line, separator_, cells_);
  if (separator_ == ' ') join_units(cells_);
  name(std::vector<std::string_view>(cells_), place);
}

void TextTable::take_names(std::string_view names, char separator, const std::string &whence,
                           const TextPlace &place, std::size_t further) {
  separator_ = separator, whence_ = whence, further_ = further, states_units_ = separator == '\0';
  std::vector<std::string_view> cells;
  split(names, states_units_ ? separator_of(names) : ' ', cells);
  if (states_units_) join_units(cells);
  name(cells, place);
}

void TextTable::name(const std::vector<std::string_view> &cells, const TextPlace &place) {
  labels_.assign(cells.begin(), cells.end());
  std::fill(cell_.begin(), cell_.end(), any);
  std::fill(value_.begin(), value_.end(), std::numeric_limits<double>::quiet_NaN());
  without_unit_.clear();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::string text = lower(unquoted(cells[k]));
    Label label = in_brackets_or_whole(text);
    if (const Label parted = after_dash(text); label.unit.empty() && power_of(parted.unit)) label = parted;
    for (const auto &[word, column, factor] : known_.words) {
      const bool length = column < known_.lengths;
      if (label.name != word || (length && !label.unit.empty() && !power_of(label.unit))) continue;
      if (has(column))
        place.fail(fmt::format("{} has two columns for one thing, \"{}\" and \"{}\". Allowed: one of them.",
                               whence_, labels_[cell_[column]], cut_short(cells[k])));
      cell_[column] = k, factor_[column] = factor;
      exponent_[column] = length ? power_of(label.unit).value_or(0) : 0;
      if (length && label.unit.empty()) without_unit_.push_back(labels_[k]);
    }
  }
  for (std::size_t column = 0; column < known_.needed; ++column)
    if (!has(column)) fail_missing(column, place);
}

// A column of that name whose unit is not known is told as such.
void TextTable::fail_missing(std::size_t column, const TextPlace &place) const {
  std::string words;
  const bool length = column < known_.lengths;
  for (const KnownColumns::Word &one : known_.words) {
    if (one.column != column) continue;
    words += (words.empty() ? "" : " or ") + std::string(one.word);
    for (const std::string &had : labels_) {
      const std::string text = lower(unquoted(had));
      if (length && (in_brackets_or_whole(text).name == one.word || after_dash(text).name == one.word))
        place.fail(
            fmt::format("column \"{}\" has a unit that is not known. Allowed: {}, as in {}_mm or {} [mm].",
                        cut_short(had), units_allowed, one.word, one.word));
    }
  }
  std::string all;
  for (const std::string &had : labels_)
    all += (all.empty() ? "" : ", ") + had;
  place.fail(fmt::format("{} names no column {}: \"{}\"{}.", whence_, words, cut_short(all),
                         length ? fmt::format(". Allowed: with its unit, as in {0}_m or {0} [mm]",
                                              words.substr(0, words.find(' ')))
                                : ""));
}

bool TextTable::is_row_of_words(std::string_view row) const {
  std::vector<std::string_view> cells;
  split(row, separator_of(row), cells);
  return std::none_of(cells.begin(), cells.end(), [](std::string_view cell) {
    return number_of(cell) || number_of(cell.substr(0, cell.find(',')));
  });
}

void TextTable::fail_count(std::size_t values, const TextPlace &place) const {
  const std::size_t columns = labels_.size();
  place.fail(fmt::format(
      "a row has {} value{}, {} names {} columns{}", values, values == 1 ? "" : "s", whence_, columns,
      separator_ == ',' && values > columns ? ". Decimal commas need columns that semicolons or tabs part."
                                            : ""));
}

bool TextTable::read_number(std::string_view text, int exponent, double &to) {
  const bool comma = separator_ != ',' && text.find(',') != text.npos;
  std::optional<double> number;
  if (!comma && exponent == 0) {
    number = number_of(text);
  } else {
    number_.assign(text);
    if (comma) number_[number_.find(',')] = '.';
    // The power of the unit goes into the text, so that 1.3 in mm has the bits of 0.0013 in m.
    const auto e = number_.find_first_of("eE");
    const auto own = e == std::string::npos ? std::optional<double>(0) : number_of(number_.substr(e + 1));
    if (exponent != 0 && own && std::abs(*own) < 1000)
      number_ = fmt::format("{}e{}", number_.substr(0, e), static_cast<int>(*own) + exponent);
    number = own ? number_of(number_) : std::nullopt;
  }
  if (!number || !std::isfinite(*number)) return false;
  decimal_commas_ = decimal_commas_ || comma;
  to = *number;
  return true;
}

void TextTable::read_row(std::string_view row, const TextPlace &place) {
  if (separator_ == '\0') separator_ = separator_of_row(row, labels_.size(), cells_);
  split(row, separator_, cells_);
  const std::size_t columns = labels_.size();
  if (cells_.size() < columns ||
      (further_ != any && cells_.size() != columns && cells_.size() != columns + further_))
    fail_count(cells_.size(), place);
  for (std::size_t column = 0; column < cell_.size(); ++column) {
    if (!has(column)) continue;
    const std::string_view text = cells_[cell_[column]];
    if (!read_number(text, exponent_[column], value_[column]))
      place.fail(
          fmt::format("column {}: \"{}\" is not a finite number", cut_short(label(column)), cut_short(text)));
    value_[column] *= factor_[column];
  }
}

std::vector<std::string> TextTable::notes() const {
  std::vector<std::string> notes;
  if (states_units_ && !without_unit_.empty())
    notes.push_back(fmt::format("column{} {} without a unit: m", without_unit_.size() > 1 ? "s" : "",
                                fmt::join(without_unit_, ", ")));
  if (decimal_commas_) notes.emplace_back("commas in numbers are decimal signs");
  return notes;
}

} // namespace platen::apps
