// Words and numbers of a text file, with the line of each.
#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace platen::fem {

// One by one, and refused by name and line: "NAME:LINE: error: ..." as std::invalid_argument.
class Words {
public:
  static constexpr int most = std::numeric_limits<int>::max();

  // Both outlive this.
  Words(std::string_view text, const std::string &name) : rest_(text), name_(name) {}

  int line() const { return line_; } // of the word read last
  [[noreturn]] void refuse(const std::string &what) const { refuse(line_, what); }
  [[noreturn]] void refuse(int line, const std::string &what) const;

  std::string_view next(); // empty at the end
  void expect(const std::string &word);
  void skip_to(const std::string &word);
  int whole(const char *what, int low, int high = most);
  void numbers(const char *what, int count); // finite ones, passed over

  static std::string quoted(std::string_view word);

private:
  std::string_view rest_;
  const std::string &name_;
  int line_ = 1;
};

} // namespace platen::fem
