// Text files that are tables, from any program: their lines with places for messages, and columns that are
// known by their names and units.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace platen::apps {

// A file while it is read: knows where it is, for messages.
struct TextPlace {
  std::string file = {};
  std::size_t line = 0;       // 0: the file as a whole
  std::string_view text = {}; // of that line, of which a character that nobody sees is named
  [[noreturn]] void fail(const std::string &what) const;
};

// Calls take(line) for each line until it returns false, and keeps the place. Lines end with \n, \r\n or \r;
// a byte order mark is passed over. Throws InputError where the file cannot be read.
void read_lines(const std::filesystem::path &path, TextPlace &place,
                const std::function<bool(std::string_view)> &take);

std::string cut_short(std::string_view text); // of a faulty line, which may be anything

// The columns that a table may have, by place: the first `needed` must be there, the first `lengths` are
// lengths with units. Others are passed over.
struct KnownColumns {
  struct Word {
    const char *word;
    std::size_t column;
    double factor = 1;
  };
  std::vector<Word> words; // any of which stands for the column
  std::size_t needed = 0, lengths = 0;
};

// Rows of numbers. A comma is the decimal sign where it does not part columns.
class TextTable {
public:
  explicit TextTable(const KnownColumns &known);

  // Names the columns by a line as the file has it, which also says what parts them ...
  void take_header(std::string_view line, const TextPlace &place);
  // ... or by names from elsewhere, with blanks between columns; '\0': what parts them is seen from the first
  // row. A row may have `further` values more, or as many as it likes.
  void take_names(std::string_view names, char separator, const std::string &whence, const TextPlace &place,
                  std::size_t further = 0);
  static constexpr std::size_t any = static_cast<std::size_t>(-1);

  bool is_named() const { return !labels_.empty(); }
  bool is_row_of_words(std::string_view row) const; // no number in it: a header
  void read_row(std::string_view row, const TextPlace &place);
  bool has(std::size_t column) const { return cell_[column] != any; }
  double value(std::size_t column) const {
    return value_[column];
  } // of the last row, SI; NaN without that column
  const std::string &label(std::size_t column) const { return labels_[cell_[column]]; } // as the file has it
  // What a user should know: units that nobody stated, decimal commas.
  std::vector<std::string> notes() const;

private:
  void name(const std::vector<std::string_view> &cells, const TextPlace &place);
  [[noreturn]] void fail_missing(std::size_t column, const TextPlace &place) const;
  [[noreturn]] void fail_count(std::size_t values, const TextPlace &place) const;
  bool read_number(std::string_view text, int exponent, double &to);

  KnownColumns known_;
  std::string whence_;
  char separator_ = '\0';
  std::size_t further_ = 0;
  std::vector<std::string> labels_; // of all columns
  // Of the known ones:
  std::vector<std::size_t> cell_; // in a row; any: there is none
  std::vector<double> factor_, value_;
  std::vector<int> exponent_; // of ten, of its unit
  std::vector<std::string> without_unit_;
  bool states_units_ = true, decimal_commas_ = false;
  std::vector<std::string_view> cells_; // of the last row
  std::string number_;
};

} // namespace platen::apps
