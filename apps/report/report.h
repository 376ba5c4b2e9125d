// A report: pictures under headings and a table of figures, on one page that needs no other file and no
// network.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

struct TableOfFigures {
  std::vector<std::string> header; // first the figure's title, then one column a run, then the gains
  std::vector<std::vector<std::string>> rows; // as many fields as the header; "-" for what was not measured
};

// The figures of the summaries; with several runs also what the first gains over each other one (its figure
// divided by theirs).
TableOfFigures table_of_figures(const std::vector<Run> &runs);

// What the summaries say of each figure: "valid", or the reasons against it, in a column for each run. No
// rows where none says anything.
TableOfFigures table_of_validity(const std::vector<Run> &runs);

// The table in columns, one line a row, each line ended.
std::string as_text(const TableOfFigures &table);

// Text that stands in HTML for `text`.
std::string escaped(const std::string &text);

class Album {
public:
  // Makes the folder where it is not there. Throws OutputError.
  explicit Album(std::filesystem::path folder);
  void begin(const std::string &heading) {
    sections_.push_back({heading, {}, {}, {}});
  } // empty: without a heading
  // Draws a picture into the folder by draw(inputs..., file); the caption tells what to see in it.
  template <class Draw, class... Inputs>
  void add(const std::string &name, const std::string &caption, const Draw &draw, const Inputs &...inputs) {
    draw(inputs..., folder_ / name);
    sections_.back().pictures.push_back({folder_ / name, caption});
  }
  // A table of its own before the pictures of the section.
  void add_table(const TableOfFigures &table) { sections_.back().tables.push_back(table); }
  // HTML of its own before the pictures of the section.
  void add_element(std::string html) { sections_.back().element = std::move(html); }
  // A sentence and a table above the figures; either may be empty.
  void lead(const std::string &sentence, const TableOfFigures &table) { head_.push_back({sentence, table}); }
  std::size_t size() const; // pictures
  // Writes report.html (title, what leads, list of sections, figures, remarks, pictures held in the page
  // itself) and prints the pictures, the page, what leads, the figures and other tables. Throws OutputError.
  void finish(const std::string &title, const TableOfFigures &figures,
              const std::vector<std::string> &remarks, std::ostream &out) const;

private:
  struct Picture {
    std::filesystem::path file; // PNG
    std::string caption;
  };
  struct Section {
    std::string heading;
    std::vector<TableOfFigures> tables;
    std::vector<Picture> pictures;
    std::string element;
    // Then it is left out.
    bool is_empty() const { return tables.empty() && pictures.empty() && element.empty(); }
    std::string anchor() const;
    std::string html() const;
  };
  struct Lead {
    std::string sentence;
    TableOfFigures table;
  };
  std::filesystem::path folder_;
  std::vector<Lead> head_;
  std::vector<Section> sections_;
};

// Draws all pictures that the first run's files allow into `folder` (made where it is not there), with more
// than one run also the comparison; puts them and the figures on the page report.html there; prints what was
// drawn, what is missing, and the figures. Needs a display. Throws InputError where a frame is damaged,
// OutputError where a picture or the page cannot be written.
void write_report(const std::vector<Run> &runs, const std::filesystem::path &folder, std::ostream &out);

} // namespace platen::apps::report
