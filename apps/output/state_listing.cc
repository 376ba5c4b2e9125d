#include "apps/output/state_listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "apps/output/checkpoint_folder.h"
#include "apps/output/output_folder.h"

namespace platen::apps {
namespace {

const std::string version_block = "/version";

bool is_version(const std::string &name) {
  return name.size() > version_block.size() &&
         name.compare(name.size() - version_block.size(), version_block.size(), version_block) == 0;
}

FoundCheckpoint newest(const std::filesystem::path &folder, std::ostream &out) {
  FoundCheckpoint found = newest_whole_checkpoint(OutputPaths(folder).checkpoints());
  for (const std::string &remark : found.remarks)
    out << "warning: " << remark << '\n';
  return found;
}

std::string rows_text(const StoredBlock &block) {
  return block.type.numbers == 1 ? fmt::format("{}", block.rows)
                                 : fmt::format("{} x {}", block.rows, block.type.numbers);
}

std::string kind_text(const BlockType &type) {
  constexpr const char *kinds[] = {"", "int", "uint", "float"}; // as BlockType::Kind
  return type.kind == BlockType::Kind::text
             ? "text"
             : fmt::format("{}{}", kinds[static_cast<std::size_t>(type.kind)], 8 * type.bytes);
}

std::string block_line(const CheckpointReader &reader, const std::string &name, std::size_t width) {
  const StoredBlock block = *reader.find(name);
  std::string line = fmt::format("{:{}}  {:>12}  {:<7}  {:<7}", name, width, rows_text(block),
                                 kind_text(block.type), block.type.unit);
  if (block.type.kind == BlockType::Kind::text) return line + "  \"" + text_of(reader, name) + "\"";
  if (block.rows == 0) return line;
  const BlockRange range = range_of(reader, name);
  if (std::isnan(range.least)) return line + "  no number";
  line += range.least == range.largest ? fmt::format("  {:.9g}", range.least)
                                       : fmt::format("  {:.9g} ... {:.9g}", range.least, range.largest);
  return line + (range.not_numbers > 0 ? fmt::format(" and {} nan", range.not_numbers) : "");
}

} // namespace

void list_state(const std::filesystem::path &folder, std::ostream &out) {
  const FoundCheckpoint found = newest(folder, out);
  const CheckpointReader reader(found.path);
  const std::vector<std::string> names = reader.names();
  std::size_t width = 0;
  for (const std::string &name : names)
    width = std::max(width, name.size());
  out << fmt::format("{}: step {}, {} blocks, {} bytes\n", found.path.string(), found.step, names.size(),
                     std::filesystem::file_size(found.path));
  out << fmt::format("{:{}}  {:>12}  {:<7}  {:<7}  least ... largest\n", "name", width, "rows", "kind",
                     "unit");
  for (const std::string &name : names) {
    if (is_version(name))
      out << fmt::format("{} (version {})\n", name.substr(0, name.size() - version_block.size()),
                         rows_of<std::int32_t>(reader, name).front());
    else
      out << block_line(reader, name, width) << '\n';
  }
}

bool compare_states(const std::filesystem::path &folder, const std::filesystem::path &other,
                    std::ostream &out) {
  const FoundCheckpoint first = newest(folder, out), second = newest(other, out);
  const std::optional<std::string> difference =
      first_difference(CheckpointReader(first.path), CheckpointReader(second.path));
  out << fmt::format("{} and {}: {}\n", first.path.string(), second.path.string(),
                     difference ? *difference : "the same to the last bit");
  return !difference;
}

} // namespace platen::apps
