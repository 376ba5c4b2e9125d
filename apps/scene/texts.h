// Texts of scenes and command lines: names tidied, characters that cannot be kept or seen, slips of the pen.
#pragma once

#include <string>
#include <vector>

namespace platen::apps {

// Without blanks at both ends, tabs and carriage returns turned into blanks: a value, a line.
std::string trimmed(const std::string &text);
// The same, each run of blanks inside shrunk to one: names and words.
std::string tidy(const std::string &text);
std::string joined(const std::vector<std::string> &words); // "a, b, c"
// As a message shows it, whatever it holds: cut, control characters replaced.
std::string shown(const std::string &text);

// Throws ValueError for a text that a .prm cannot hold and give back.
void check_characters(const std::string &text);
// "holds U+00A0 (no-break space) in column 18, which cannot be seen. Allowed: blanks and tabs." of the first
// such character of `part`; the column is that in `whole`, which holds it, left out where it does not. ""
// where there is none.
std::string unseen_in(const std::string &part, const std::string &whole);

// Of the path of an entry or a section, "Loading/Stage 1/Until": the section that it stands in, "" where
// there is none, and its own name.
std::string section_of(const std::string &path);
std::string last_name(const std::string &path);

// The candidate nearest to a word, by letters inserted, dropped, changed or swapped, regardless of case; ""
// where none is near enough to be meant.
std::string nearest_word(const std::string &word, const std::vector<std::string> &candidates);
// The count of such changes.
int edit_distance(const std::string &a, const std::string &b);
// " Did you mean \"hertz\"?" of the nearest one; `otherwise` where none is near.
std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates,
                         const std::string &otherwise = "");

} // namespace platen::apps
