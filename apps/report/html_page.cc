#include "apps/report/html_page.h"

#include <vtkBase64Utilities.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "apps/io/file.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

constexpr const char *look = R"(<style>
body { font-family: sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #111; background: #fff; }
table { border-collapse: collapse; } td, th { padding: 0.2rem 1rem; border-bottom: 1px solid #ccc; text-align: right; }
td:first-child, th:first-child { text-align: left; padding-left: 0; }
h2 { margin-top: 3rem; border-bottom: 2px solid #0072b2; } nav { margin: 1rem 0; } a { color: #0072b2; }
figure { margin: 1.5rem 0 2.5rem; } img { max-width: 100%; } figcaption { margin-top: 0.5rem; color: #333; }
</style>
)";

std::string base64_of(const std::filesystem::path &file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream || bytes.empty()) throw OutputError(file.string() + ": cannot be read back");
  std::vector<unsigned char> text(bytes.size() / 3 * 4 + 8);
  const auto length = vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char *>(bytes.data()),
                                                 bytes.size(), text.data());
  return {text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length)};
}

std::string row_of(const std::vector<std::string> &fields, const std::string &kind) {
  std::string row = "<tr>";
  for (const std::string &field : fields)
    row.append("<").append(kind).append(">").append(escaped(field)).append("</").append(kind).append(">");
  return row + "</tr>\n";
}

std::string anchor_of(const Section &section) {
  std::string anchor;
  for (const char letter : section.title)
    anchor += letter == ' ' ? '-' : letter;
  return escaped(anchor);
}

std::string links_to(const std::vector<Section> &sections) {
  std::string links;
  for (const Section &section : sections)
    if (!section.pictures.empty() && !section.title.empty())
      links += (links.empty() ? "<nav>" : " &middot; ") + ("<a href=\"#" + anchor_of(section)) + "\">" +
               escaped(section.title) + "</a>";
  return links.empty() ? "" : links + "</nav>\n";
}

} // namespace

std::string escaped(const std::string &text) {
  std::string html;
  for (const char letter : text)
    switch (letter) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += letter;
    }
  return html;
}

void write_page(const std::string &title, const TableOfFigures &figures,
                const std::vector<std::string> &remarks, const std::vector<Section> &sections,
                const std::filesystem::path &html) {
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" << escaped(title)
      << "</title>\n"
      << look << "</head>\n<body>\n<h1>" << escaped(title) << "</h1>\n"
      << links_to(sections) << "<table>\n"
      << row_of(figures.header, "th");
  for (const auto &row : figures.rows)
    out << row_of(row, "td");
  out << "</table>\n<ul>\n";
  for (const std::string &remark : remarks)
    out << "<li>" << escaped(remark) << "</li>\n";
  out << "</ul>\n";
  for (const Section &section : sections) {
    if (section.pictures.empty()) continue;
    if (!section.title.empty())
      out << "<h2 id=\"" << anchor_of(section) << "\">" << escaped(section.title) << "</h2>\n";
    for (const Picture &picture : section.pictures)
      out << "<figure><img alt=\"" << escaped(picture.caption) << "\" src=\"data:image/png;base64,"
          << base64_of(picture.file) << "\"><figcaption>" << escaped(picture.caption)
          << "</figcaption></figure>\n";
  }
  out << "</body>\n</html>\n";
  write_text_aside(html, out.str());
}

void write_html(const std::vector<Run> &runs, const TableOfFigures &figures,
                const std::vector<Section> &sections, const std::filesystem::path &html) {
  std::vector<std::string> remarks;
  for (const Run &run : runs) {
    if (run.summary.contains("version") && run.summary["version"].is_string())
      remarks.push_back(run.name + ": " + run.summary["version"].get<std::string>());
    for (const std::string &remark : run.remarks)
      remarks.push_back(run.name + ": " + remark);
  }
  write_page(runs.front().title, figures, remarks, sections, html);
}

} // namespace platen::apps::report
