#include "apps/output/specimen_csv.h"

#include <fmt/format.h>

#include <iterator>
#include <string>

namespace platen::apps {
namespace {

constexpr std::size_t write_bytes = 1 << 20; // of text collected before it is written

std::string shape_line(const dem::Shape &shape) {
  if (shape.kind == dem::ShapeKind::cylinder)
    return fmt::format("{} cylinder radius_m={} height_m={}\n", specimen_shape_words, shape.radius,
                       shape.height);
  if (shape.kind == dem::ShapeKind::disc)
    return fmt::format("{} disc radius_m={} thickness_m={}\n", specimen_shape_words, shape.radius,
                       shape.width_y);
  return fmt::format("{} box width_x_m={} width_y_m={} height_m={}\n", specimen_shape_words, shape.width_x,
                     shape.width_y, shape.height);
}

} // namespace

void write_specimen_csv(OutputFile &to, const dem::Specimen &specimen) {
  std::string text = shape_line(specimen.shape) + std::string(specimen_header) + '\n';
  for (std::size_t k = 0; k < specimen.size(); ++k) {
    const Vector3 &c = specimen.centre[k];
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", c.x, c.y, c.z, specimen.radius[k]);
    if (text.size() < write_bytes) continue;
    to.write(text);
    text.clear();
  }
  to.write(text);
}

void write_specimen_csv(const std::filesystem::path &path, const dem::Specimen &specimen) {
  write_aside(path, [&](const std::filesystem::path &part) {
    OutputFile file(part);
    write_specimen_csv(file, specimen);
    file.close();
  });
}

} // namespace platen::apps
