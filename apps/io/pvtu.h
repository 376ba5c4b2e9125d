// A large cloud or set of lines in several VTU files (pieces), and the file that ParaView opens instead
// (.pvtu).
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "apps/io/vtu.h"

namespace platen::apps {

// Rows in pieces of a fixed length, the last one shorter: which files there are depends on nothing else.
struct Pieces { // at least one row
  std::size_t rows = 0, length = 1;
  std::size_t count() const { return (rows + length - 1) / length; }
  std::size_t begin(std::size_t piece) const { return piece * length; }
  std::size_t end(std::size_t piece) const { return piece + 1 < count() ? begin(piece + 1) : rows; }
};

// frames/bonds_000012.pvtu, 3 -> frames/bonds_000012_0003.vtu
std::filesystem::path piece_path(const std::filesystem::path &pvtu, std::size_t piece);

// One piece: points and their fields in its range of rows, each a vertex cell. Errors as of write_points
// (vtu.h).
void write_piece_of_points(const std::filesystem::path &pvtu, double time, const std::vector<Vector3> &points,
                           const std::vector<Field> &point_fields, const FrameValues &of_frame,
                           const Pieces &pieces, std::size_t piece);

// One piece: lines in its range with their fields, and the points that they end at. Errors as of write_lines.
void write_piece_of_lines(const std::filesystem::path &pvtu, double time, const std::vector<Vector3> &points,
                          const std::vector<std::array<int, 2>> &lines, const std::vector<Field> &line_fields,
                          const FrameValues &of_frame, const Pieces &pieces, std::size_t piece);

// The file that names the pieces and what fields they have, once they are there. Throws OutputError.
void write_pvtu(const std::filesystem::path &pvtu, double time, const std::vector<Field> &point_fields,
                const std::vector<Field> &line_fields, const FrameValues &of_frame, std::size_t pieces);

// The pieces that a .pvtu names, in its folder; empty where it is not a whole one.
std::vector<std::filesystem::path> pieces_of(const std::filesystem::path &pvtu);

} // namespace platen::apps
