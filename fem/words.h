// Words and numbers of a text file, with the line of each.
#pragma once

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace platen::fem {

// Reads words one by one; errors give name and line: "NAME:LINE: error: ..." as std::invalid_argument.
class Words {
public:
  static constexpr int most = std::numeric_limits<int>::max();

  // Both must outlive this object.
  Words(std::string_view text, const std::string &name) : rest_(text), name_(name) {}

  int line() const { return line_; } // of the word read last
  [[noreturn]] void refuse(const std::string &what) const { refuse(line_, what); }
  [[noreturn]] void refuse(int line, const std::string &what) const;

  std::string_view next(); // empty at the end
  void expect(const std::string &word);
  void skip_to(const std::string &word);
  int whole(const char *what, int low, int high = most);
  void numbers(const char *what, int count); // checks that they are finite and skips them

  static std::string quoted(std::string_view word);

private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  template <class Number>
  static bool is_all(std::string_view word, Number &value) {
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    return read.ec == std::errc() && read.ptr == word.data() + word.size();
  }

  std::string_view rest_;
  const std::string &name_;
  int line_ = 1;
};

inline void Words::refuse(int line, const std::string &what) const {
  throw std::invalid_argument(name_ + ":" + std::to_string(line) + ": error: " + what);
}

inline std::string_view Words::next() {
  while (!rest_.empty() && is_space(rest_.front())) {
    line_ += rest_.front() == '\n';
    rest_.remove_prefix(1);
  }
  std::size_t length = 0;
  while (length < rest_.size() && !is_space(rest_[length]))
    ++length;
  const std::string_view word = rest_.substr(0, length);
  rest_.remove_prefix(length);
  return word;
}

inline void Words::expect(const std::string &word) {
  const std::string_view found = next();
  if (found != word) refuse(quoted(found) + " where " + word + " is due");
}

inline void Words::skip_to(const std::string &word) {
  const int from = line_;
  for (std::string_view found = next(); found != word; found = next())
    if (found.empty()) refuse(from, "the section that begins here has no " + word);
}

inline int Words::whole(const char *what, int low, int high) {
  const std::string_view word = next();
  int value = 0;
  if (!is_all(word, value) || value < low || value > high)
    refuse(std::string(what) + " = " + quoted(word) + ". Allowed: a whole number from " +
           std::to_string(low) + (high == most ? "" : " to " + std::to_string(high)));
  return value;
}

inline void Words::numbers(const char *what, int count) {
  for (int k = 0; k < count; ++k) {
    const std::string_view word = next();
    double value = 0;
    if (!is_all(word, value) || !std::isfinite(value))
      refuse(std::string(what) + " = " + quoted(word) + " is not a finite number");
  }
}

inline std::string Words::quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  if (word.empty()) return "the end of the file";
  return "\"" + std::string(word.substr(0, longest)) + (word.size() > longest ? "...\"" : "\"");
}

} // namespace platen::fem
