#include "base/characters.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace platen {
namespace {

struct Block {
  std::uint32_t first, last;
  const char *name;
};

constexpr Block unseen[] = {{0x80, 0x9f, "control character"},
                            {0xa0, 0xa0, "no-break space"},
                            {0xad, 0xad, "soft hyphen"},
                            {0x34f, 0x34f, "grapheme joiner"},
                            {0x61c, 0x61c, "direction mark"},
                            {0x115f, 0x1160, "filler"},
                            {0x1680, 0x1680, "unusual space"},
                            {0x180e, 0x180e, "vowel separator"},
                            {0x2000, 0x200a, "unusual space"},
                            {0x200b, 0x200b, "zero width space"},
                            {0x200c, 0x200d, "zero width joiner"},
                            {0x200e, 0x200f, "direction mark"},
                            {0x2028, 0x2029, "line separator"},
                            {0x202a, 0x202e, "direction mark"},
                            {0x202f, 0x202f, "narrow no-break space"},
                            {0x205f, 0x205f, "unusual space"},
                            {0x2060, 0x2060, "word joiner"},
                            {0x2061, 0x206f, "invisible sign"},
                            {0x3000, 0x3000, "ideographic space"},
                            {0x3164, 0x3164, "filler"},
                            {0xfe00, 0xfe0f, "variation selector"},
                            {0xfeff, 0xfeff, "byte order mark"},
                            {0xffa0, 0xffa0, "filler"},
                            {0xe0000, 0xe0fff, "tag"}};

constexpr std::uint32_t greek_mu = 0x3bc;
constexpr Block look_alikes[] = {{0x370, 0x3ff, "Greek letter"},
                                 {0x400, 0x52f, "Cyrillic letter"},
                                 {0x2010, 0x2015, "dash"},
                                 {0x2018, 0x201f, "quote"},
                                 {0x2026, 0x2026, "three dots"},
                                 {0x2212, 0x2212, "minus sign"},
                                 {0xff01, 0xff5e, "full-width character"}};

struct Decoded {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = true;
};

Decoded decoded(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char lead = byte(at);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xf0 && lead < 0xf8   ? 4
                            : lead >= 0xe0 && lead < 0xf0 ? 3
                            : lead >= 0xc2                ? 2
                                                          : 0;
  if (bytes == 0 || lead >= 0xf8 || at + bytes > text.size()) return {lead, 1, false};
  std::uint32_t code = lead & (0xffu >> (bytes + 1));
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(at + k) & 0xc0) != 0x80) return {lead, 1, false};
    code = (code << 6) | (byte(at + k) & 0x3fu);
  }
  return {code, bytes, true};
}

template <std::size_t n>
const char *name_in(const Block (&blocks)[n], std::uint32_t code) {
  for (const Block &one : blocks)
    if (code >= one.first && code <= one.last) return one.name;
  return nullptr;
}

std::string name_of(const Decoded &one, const char *name) {
  std::array<char, 32> number{};
  if (!one.valid) {
    std::snprintf(number.data(), number.size(), "the byte %02X", one.code);
    return std::string(number.data()) + ", which is no UTF-8";
  }
  std::snprintf(number.data(), number.size(), "U+%04X", one.code);
  return std::string(number.data()) + " (" + name + ")";
}

// The first character for which `name` returns a name.
template <class Name>
std::optional<Character> first_named(std::string_view text, const Name &name) {
  Character found;
  for (std::size_t at = 0; at < text.size(); ++found.column) {
    const Decoded one = decoded(text, at);
    if (const char *word = name(one)) {
      found.at = at, found.bytes = one.bytes, found.name = name_of(one, word);
      return found;
    }
    at += one.bytes;
  }
  return std::nullopt;
}

std::string replaced(const std::string &text, const std::string &what, const std::string &by) {
  std::string result = text;
  for (std::size_t at = result.find(what); at != std::string::npos; at = result.find(what, at + by.size()))
    result.replace(at, what.size(), by);
  return result;
}

} // namespace

std::optional<Character> first_unseen(std::string_view text) {
  return first_named(text,
                     [](const Decoded &one) { return one.valid ? name_in(unseen, one.code) : "no UTF-8"; });
}

std::optional<Character> first_look_alike(std::string_view text) {
  return first_named(text, [](const Decoded &one) {
    return one.valid && one.code != greek_mu ? name_in(look_alikes, one.code) : nullptr;
  });
}

std::string text_of_odd_character(std::string_view text) {
  std::optional<Character> odd = first_unseen(text);
  if (!odd) odd = first_look_alike(text);
  return odd ? odd->name + " in column " + std::to_string(odd->column) : "";
}

std::string with_plain_line_ends(const std::string &text) {
  if (text.find('\r') == std::string::npos) return text;
  return replaced(replaced(text, "\r\n", "\n"), "\r", "\n");
}

std::string with_micro_sign(const std::string &text) {
  return replaced(text, "\xce\xbc", "\xc2\xb5");
}

} // namespace platen
