// All of a report on one page that needs no other file and no network.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/comparison.h"
#include "apps/report/run_folder.h"

namespace platen::apps::report {

struct Picture {
  std::filesystem::path file; // PNG, already written
  std::string caption;        // what to see in it
};

struct Section {
  std::string title;             // empty: without a heading
  std::vector<Picture> pictures; // without any the section is left out
};

// Writes the page: title, list of sections, figures, remarks, pictures (held in the page itself). Throws
// OutputError.
void write_html(const std::vector<Run> &runs, const TableOfFigures &figures,
                const std::vector<Section> &sections, const std::filesystem::path &html);

// The same of anything else: a list of remarks in place of what is known of the runs.
void write_page(const std::string &title, const TableOfFigures &figures,
                const std::vector<std::string> &remarks, const std::vector<Section> &sections,
                const std::filesystem::path &html);

// Text that stands in HTML for `text`.
std::string escaped(const std::string &text);

} // namespace platen::apps::report
