// Letters of pictures: which font has them, and lines that are short enough. Text is UTF-8.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace platen::apps::report {

// Its code points; a byte that is no UTF-8 counts as U+FFFD.
std::vector<char32_t> code_points(const std::string &text);

// The same text with U+FFFD in place of bytes that are no UTF-8.
std::string valid_utf8(const std::string &text);

// A file of a font of the machine that has every letter of the text, else the one that has the most of them;
// empty where the letters of VTK's own font do (Latin 1), and where the machine has no font.
std::string font_file_for(const std::string &text, bool bold);

// Up to `longest` letters; of a longer text the beginning and "...".
std::string shortened(const std::string &text, std::size_t longest);

// Broken at blanks, and within words that are longer than a line, into lines of at most `columns` letters.
std::string wrapped(const std::string &text, std::size_t columns);

} // namespace platen::apps::report
