// Whole text files, with the reason where they cannot be read.
#pragma once

#include <string>

namespace platen::apps {

// Throws InputError, "case.prm: error: cannot be read: No such file or directory", for what is missing, a
// folder, unreadable, larger than a scene can be, or not text.
std::string read_text(const std::string &path);

// UTF-8 text as some editors write it begins with three bytes that are no part of it.
std::string without_byte_order_mark(const std::string &text);

} // namespace platen::apps
