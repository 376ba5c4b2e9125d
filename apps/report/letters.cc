#include "apps/report/letters.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace platen::apps::report {
namespace {

constexpr char32_t replacement = 0xFFFD;

// The code point that begins at `at`, which is moved behind it.
char32_t next_code_point(const std::string &text, std::size_t &at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(at++);
  if (first < 0x80) return first;
  const int further = first >= 0xF0 && first < 0xF8 ? 3 : first >= 0xE0 ? 2 : first >= 0xC2 ? 1 : 0;
  if (further == 0 || first >= 0xF8) return replacement;
  char32_t point = first & (0x3Fu >> further);
  for (int k = 0; k < further; ++k) {
    if (at >= text.size() || (byte(at) & 0xC0u) != 0x80u) return replacement;
    point = (point << 6) | (byte(at++) & 0x3Fu);
  }
  return point;
}

// Letters with their bytes.
std::vector<std::string> letters_of(const std::string &text) {
  std::vector<std::string> letters;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = at;
    next_code_point(text, at);
    letters.push_back(text.substr(start, at - start));
  }
  return letters;
}

struct Free {
  void operator()(FcPattern *p) const { FcPatternDestroy(p); }
  void operator()(FcCharSet *s) const { FcCharSetDestroy(s); }
  void operator()(FcFontSet *s) const { FcFontSetDestroy(s); }
};

std::string best_font(const std::set<char32_t> &wanted, bool bold) {
  const std::unique_ptr<FcCharSet, Free> letters(FcCharSetCreate());
  for (const char32_t point : wanted)
    FcCharSetAddChar(letters.get(), point);
  const std::unique_ptr<FcPattern, Free> pattern(FcPatternCreate());
  FcPatternAddString(pattern.get(), FC_FAMILY, reinterpret_cast<const FcChar8 *>("sans-serif"));
  FcPatternAddInteger(pattern.get(), FC_WEIGHT, bold ? FC_WEIGHT_BOLD : FC_WEIGHT_REGULAR);
  FcPatternAddBool(pattern.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, pattern.get(), FcMatchPattern);
  FcDefaultSubstitute(pattern.get());
  FcResult result = FcResultNoMatch;
  const std::unique_ptr<FcFontSet, Free> fonts(FcFontSort(nullptr, pattern.get(), FcFalse, nullptr, &result));
  std::string best;
  FcChar32 most = 0;
  for (int k = 0; fonts && k < fonts->nfont; ++k) {
    FcCharSet *has = nullptr;
    FcChar8 *file = nullptr;
    FcBool scalable = FcFalse;
    if (FcPatternGetCharSet(fonts->fonts[k], FC_CHARSET, 0, &has) != FcResultMatch ||
        FcPatternGetString(fonts->fonts[k], FC_FILE, 0, &file) != FcResultMatch ||
        FcPatternGetBool(fonts->fonts[k], FC_SCALABLE, 0, &scalable) != FcResultMatch || scalable == FcFalse)
      continue;
    const FcChar32 count = FcCharSetIntersectCount(has, letters.get());
    if (count > most) most = count, best = reinterpret_cast<const char *>(file);
  }
  return best;
}

} // namespace

std::vector<char32_t> code_points(const std::string &text) {
  std::vector<char32_t> points;
  for (std::size_t at = 0; at < text.size();)
    points.push_back(next_code_point(text, at));
  return points;
}

std::string valid_utf8(const std::string &text) {
  std::string valid;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = at;
    const bool bad = next_code_point(text, at) == replacement;
    valid += bad ? "\xEF\xBF\xBD" : text.substr(start, at - start);
  }
  return valid;
}

std::string font_file_for(const std::string &text, bool bold) {
  constexpr char32_t latin_1 = 0x100;
  const std::vector<char32_t> points = code_points(text);
  if (std::all_of(points.begin(), points.end(), [](char32_t point) { return point < latin_1; })) return "";
  std::set<char32_t> wanted(points.begin(), points.end());
  wanted.erase(U'\n');
  static std::map<std::pair<std::set<char32_t>, bool>, std::string> known; // asking takes milliseconds
  const auto [found, is_new] = known.insert({{wanted, bold}, ""});
  if (is_new) found->second = best_font(wanted, bold);
  return found->second;
}

std::string shortened(const std::string &text, std::size_t longest) {
  const std::vector<std::string> letters = letters_of(text);
  if (letters.size() <= longest) return text;
  std::string start;
  for (std::size_t k = 0; k + 3 < longest; ++k)
    start += letters[k];
  return start + "...";
}

std::string wrapped(const std::string &text, std::size_t columns) {
  columns = std::max<std::size_t>(columns, 1);
  std::vector<std::vector<std::string>> words{{}};
  for (const std::string &letter : letters_of(text))
    if (letter == " " || letter == "\n")
      words.emplace_back();
    else
      words.back().push_back(letter);
  std::string lines;
  std::size_t length = 0; // of the last line
  for (const std::vector<std::string> &word : words) {
    if (word.empty()) continue;
    if (length > 0 && length + 1 + word.size() > columns)
      lines += '\n', length = 0;
    else if (length > 0)
      lines += ' ', ++length;
    for (const std::string &letter : word) {
      if (length == columns) lines += '\n', length = 0;
      lines += letter, ++length;
    }
  }
  return lines;
}

} // namespace platen::apps::report
