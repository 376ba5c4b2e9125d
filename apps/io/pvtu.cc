#include "apps/io/pvtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "apps/io/file.h"
#include "apps/io/vtk_xml.h"

namespace platen::apps {
namespace {

std::vector<std::size_t> rows_of(const Pieces &pieces, std::size_t piece) {
  std::vector<std::size_t> rows(pieces.end(piece) - pieces.begin(piece));
  std::iota(rows.begin(), rows.end(), pieces.begin(piece));
  return rows;
}

std::vector<Field> taken(const std::vector<Field> &fields, const std::vector<std::size_t> &rows) {
  std::vector<Field> some;
  for (const Field &field : fields)
    std::visit(
        [&](const auto &values) {
          const auto width = static_cast<std::size_t>(field.components);
          std::decay_t<decltype(values)> chosen;
          chosen.reserve(rows.size() * width);
          for (const std::size_t row : rows)
            for (std::size_t c = 0; c < width; ++c)
              chosen.push_back(values.at(row * width + c));
          some.emplace_back(field.name, std::move(chosen), field.components);
        },
        field.values);
  return some;
}

void add_arrays(std::string &text, const char *what, const std::vector<Field> &fields) {
  const auto first =
      std::find_if(fields.begin(), fields.end(), [](const Field &field) { return field.components == 1; });
  const std::string scalars =
      first == fields.end() ? "" : fmt::format(" Scalars=\"{}\"", escaped_xml(first->name));
  fmt::format_to(std::back_inserter(text), "    <{}{}>\n", what, scalars);
  for (const Field &field : fields)
    fmt::format_to(std::back_inserter(text),
                   "      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n",
                   std::holds_alternative<std::vector<int>>(field.values) ? "Int32" : "Float64",
                   escaped_xml(field.name), field.components);
  fmt::format_to(std::back_inserter(text), "    </{}>\n", what);
}

} // namespace

std::filesystem::path piece_path(const std::filesystem::path &pvtu, std::size_t piece) {
  std::filesystem::path path = pvtu;
  return path.replace_filename(fmt::format("{}_{:04}.vtu", pvtu.stem().string(), piece));
}

void write_piece_of_points(const std::filesystem::path &pvtu, double time, const std::vector<Vector3> &points,
                           const std::vector<Field> &point_fields, const FrameValues &of_frame,
                           const Pieces &pieces, std::size_t piece) {
  const auto at = [&](std::size_t row) { return points.begin() + static_cast<std::ptrdiff_t>(row); };
  write_points(piece_path(pvtu, piece), time, {at(pieces.begin(piece)), at(pieces.end(piece))},
               taken(point_fields, rows_of(pieces, piece)), of_frame);
}

void write_piece_of_lines(const std::filesystem::path &pvtu, double time, const std::vector<Vector3> &points,
                          const std::vector<std::array<int, 2>> &lines, const std::vector<Field> &line_fields,
                          const FrameValues &of_frame, const Pieces &pieces, std::size_t piece) {
  const std::vector<std::size_t> rows = rows_of(pieces, piece);
  std::vector<int> ends; // the points of this piece, ascending
  for (const std::size_t row : rows)
    ends.insert(ends.end(), lines[row].begin(), lines[row].end());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const auto place = [&](int point) {
    return static_cast<int>(std::lower_bound(ends.begin(), ends.end(), point) - ends.begin());
  };
  std::vector<Vector3> own_points;
  for (const int point : ends) {
    if (point < 0 || static_cast<std::size_t>(point) >= points.size())
      throw std::logic_error("a line ends at no point");
    own_points.push_back(points[static_cast<std::size_t>(point)]);
  }
  std::vector<std::array<int, 2>> own_lines;
  for (const std::size_t row : rows)
    own_lines.push_back({place(lines[row][0]), place(lines[row][1])});
  write_lines(piece_path(pvtu, piece), time, own_points, own_lines, {}, taken(line_fields, rows), of_frame);
}

void write_pvtu(const std::filesystem::path &pvtu, double time, const std::vector<Field> &point_fields,
                const std::vector<Field> &line_fields, const FrameValues &of_frame, std::size_t pieces) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n    <FieldData>\n";
  FrameValues values{{"TimeValue", time}};
  values.insert(values.end(), of_frame.begin(), of_frame.end());
  for (const auto &[name, value] : values)
    fmt::format_to(std::back_inserter(text),
                   "      <DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}"
                   "</DataArray>\n",
                   escaped_xml(name), value);
  text += "    </FieldData>\n";
  add_arrays(text, "PPointData", point_fields);
  add_arrays(text, "PCellData", line_fields);
  text +=
      "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n"
      "    </PPoints>\n";
  for (std::size_t piece = 0; piece < pieces; ++piece)
    fmt::format_to(std::back_inserter(text), "    <Piece Source=\"{}\"/>\n",
                   escaped_xml(piece_path(pvtu, piece).filename().string()));
  write_text_aside(pvtu, text + "  </PUnstructuredGrid>\n</VTKFile>\n");
}

std::vector<std::filesystem::path> pieces_of(const std::filesystem::path &pvtu) {
  const auto root = read_xml(pvtu);
  vtkXMLDataElement *grid = root ? root->FindNestedElementWithName("PUnstructuredGrid") : nullptr;
  std::vector<std::filesystem::path> found;
  for (int k = 0; grid != nullptr && k < grid->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement *entry = grid->GetNestedElement(k);
    if (std::string(entry->GetName()) != "Piece") continue;
    const char *source = entry->GetAttribute("Source");
    if (source == nullptr) return {};
    found.push_back(pvtu.parent_path() / source);
  }
  return found;
}

} // namespace platen::apps
