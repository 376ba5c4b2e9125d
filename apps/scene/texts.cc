#include "apps/scene/texts.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>

#include "apps/scene/errors.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

} // namespace

std::string trimmed(const std::string &text) {
  std::string result = text;
  for (char &c : result)
    if (c == '\t' || c == '\r') c = ' ';
  const auto first = result.find_first_not_of(' ');
  return first == std::string::npos ? "" : result.substr(first, result.find_last_not_of(' ') - first + 1);
}

std::string tidy(const std::string &text) {
  std::string result;
  for (const char c : trimmed(text))
    if (c != ' ' || result.back() != ' ') result += c;
  return result;
}

std::string joined(const std::vector<std::string> &words) {
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string shown(const std::string &text) {
  constexpr std::size_t longest = 80; // a message stays readable whatever the value
  std::string cut = text.size() > longest ? text.substr(0, longest) + "..." : text;
  std::replace_if(cut.begin(), cut.end(), is_control, '?');
  return cut;
}

// What a .prm cannot hold cannot be written back, wherever it came from.
void check_characters(const std::string &text) {
  if (text.find('#') != std::string::npos)
    throw ValueError("holds a \"#\", which begins a comment in a scene file");
  if (std::any_of(text.begin(), text.end(), is_control))
    throw ValueError("holds a control character or a line end");
  if (!text.empty() && text.back() == '\\') throw ValueError("ends with a backslash, which continues a line");
}

std::string unseen_in(const std::string &part, const std::string &whole) {
  const std::optional<Character> odd = first_unseen(part);
  if (!odd) return "";
  const std::size_t there = whole.find(part), at = there == std::string::npos
                                                       ? whole.find(part.substr(odd->at, odd->bytes))
                                                       : there + odd->at;
  std::string column;
  if (at != std::string::npos) {
    const std::size_t line = whole.rfind('\n', at) + 1; // of a continued one the last
    const std::string before = whole.substr(line, at - line);
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
    const auto inside = static_cast<std::size_t>(std::count_if(before.begin(), before.end(), continues));
    column = " in column " + std::to_string(1 + before.size() - inside);
  }
  return "holds " + odd->name + column + ", which cannot be seen. Allowed: blanks and tabs.";
}

int edit_distance(const std::string &a, const std::string &b) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      const int changed = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + changed});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[n][m];
}

std::string section_of(const std::string &path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string last_name(const std::string &path) {
  return path.substr(path.rfind('/') + 1);
}

std::string nearest_word(const std::string &word, const std::vector<std::string> &candidates) {
  constexpr std::size_t longest = 200; // more is no slip of the pen, and the distance costs its square
  if (word.size() > longest) return "";
  std::string nearest;
  int least = (static_cast<int>(word.size()) + 2) / 3 + 1;
  for (const std::string &candidate : candidates) {
    const int longer = std::abs(static_cast<int>(word.size()) - static_cast<int>(candidate.size()));
    if (longer >= least) continue; // so is the distance
    const int distance = edit_distance(word, candidate);
    if (distance < least && distance < static_cast<int>(candidate.size()))
      least = distance, nearest = candidate;
  }
  return nearest;
}

std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates,
                         const std::string &otherwise) {
  const std::string nearest = nearest_word(word, candidates);
  return nearest.empty() ? otherwise : " Did you mean \"" + nearest + "\"?";
}

} // namespace platen::apps
