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
  std::string caption;        // one sentence
};

// Writes the page: title, figures, remarks, pictures (held in the page itself). Throws OutputError.
void write_html(const std::vector<Run> &runs, const TableOfFigures &figures,
                const std::vector<Picture> &pictures, const std::filesystem::path &html);

// The same of anything else: a list of remarks in place of what is known of the runs.
void write_page(const std::string &title, const TableOfFigures &figures,
                const std::vector<std::string> &remarks, const std::vector<Picture> &pictures,
                const std::filesystem::path &html);

// Text that stands in HTML for `text`.
std::string escaped(const std::string &text);

} // namespace platen::apps::report
