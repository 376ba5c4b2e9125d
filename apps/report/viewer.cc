#include "apps/report/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

#include "apps/report/base64.h"
#include "apps/report/cracks.h"
#include "apps/report/joined.h"
#include "apps/report/sleeve.h"
#include "apps/report/viewer_text.h"
#include "apps/scene/errors.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

constexpr int largest_16 = 65535;

// Numbers of one axis or kind as multiples of a step from an origin.
struct Steps {
  double origin = 0, step = 1;
  std::uint16_t of(double value) const {
    return static_cast<std::uint16_t>(
        std::clamp(std::round((value - origin) / step), 0.0, double(largest_16)));
  }
};

class Bytes {
public:
  explicit Bytes(std::vector<unsigned char> &bytes) : bytes_(bytes) {}
  void one(int value) { bytes_.push_back(static_cast<unsigned char>(value & 0xff)); }
  void two(std::uint16_t value) { one(value & 0xff), one(value >> 8); }

private:
  std::vector<unsigned char> &bytes_;
};

// Places of all three axes with one step. What has flown further from the specimen than it is large is drawn
// at that border.
struct Box {
  Position low, high; // of the specimen before the test
  std::array<Steps, 3> steps;
};

Box box_of(const Extent &extent) {
  Box box;
  box.low = {-extent.half_width, -extent.half_depth, extent.bottom};
  box.high = {extent.half_width, extent.half_depth, extent.top};
  double widest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    widest = std::max(widest, box.high[k] - box.low[k]);
  constexpr double margin = 0.25; // of the longest side, beyond each face
  for (std::size_t k = 0; k < 3; ++k)
    box.steps[k] = {box.low[k] - margin * widest, (1 + 2 * margin) * widest / largest_16};
  return box;
}

int damage_byte(const Spheres &spheres, std::size_t k) {
  return static_cast<int>(std::round(255 * std::clamp(spheres.damage(k), 0.0, 1.0)));
}

// 0: the largest piece; 1 to 254: the others by size, again from 1; 255: a sphere by itself.
std::vector<int> piece_bytes(const Spheres &spheres) {
  std::map<int, std::size_t> sizes;
  for (const int piece : spheres.fragment)
    ++sizes[piece];
  std::vector<int> bytes;
  for (const int piece : spheres.fragment)
    bytes.push_back(sizes[piece] == 1 ? 255 : piece == 0 ? 0 : 1 + (piece - 1) % 254);
  bytes.resize(spheres.size(), 0);
  return bytes;
}

void add_frame(const Spheres &spheres, const Box &box, Bytes bytes) {
  for (std::size_t k = 0; k < spheres.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      bytes.two(box.steps[axis].of(spheres.position[k][axis]));
  for (std::size_t k = 0; k < spheres.size(); ++k)
    bytes.one(damage_byte(spheres, k));
  for (const int piece : piece_bytes(spheres))
    bytes.one(piece);
}

void add_cracks(const std::vector<Crack> &cracks, const std::vector<double> &times, const Box &box,
                const Steps &radii, Bytes bytes) {
  for (const Crack &crack : cracks)
    for (std::size_t axis = 0; axis < 3; ++axis)
      bytes.two(box.steps[axis].of(crack.place[axis]));
  for (const Crack &crack : cracks)
    for (std::size_t axis = 0; axis < 3; ++axis)
      bytes.one(static_cast<int>(std::lround(127 * crack.normal[axis])));
  for (const Crack &crack : cracks)
    bytes.one(crack.in_tension ? 0 : 1);
  for (const Crack &crack : cracks)
    bytes.two(radii.of(std::sqrt(crack.area / pi)));
  for (const Crack &crack : cracks) {
    const auto since = std::lower_bound(times.begin(), times.end(), crack.time);
    bytes.one(static_cast<int>(since - times.begin()));
  }
}

// Of each platen; two supports are two.
Json platens_at(const Run &run, double time) {
  Json boxes = Json::array();
  if (run.platens.empty()) return boxes;
  const Frame &frame = nearest(run.platens, time);
  for (const auto &part : frame.parts)
    for (const Bounds &bounds : bounds_of_bodies(*read_frame({frame.time, {part}})))
      boxes.push_back(bounds);
  return boxes;
}

// The outer face of the sleeve: places of its corners in every frame; corners of each face in `meta`.
void add_sleeve(const Run &run, const std::vector<double> &times, const Box &box, Json &meta, Bytes bytes) {
  const SleeveFaces faces = faces_of_sleeve(run.sleeve.front());
  std::vector<int> number(faces.points.size(), -1); // of the corners of the outer face alone
  std::vector<std::size_t> corners;
  Json outer = Json::array();
  for (const auto &face : faces.outer)
    for (const int corner : face) {
      int &at = number[static_cast<std::size_t>(corner)];
      if (at < 0) at = static_cast<int>(corners.size()), corners.push_back(static_cast<std::size_t>(corner));
      outer.push_back(at);
    }
  const auto add = [&](const std::vector<Position> &places) {
    for (const std::size_t corner : corners)
      for (std::size_t axis = 0; axis < 3; ++axis)
        bytes.two(box.steps[axis].of(places[corner][axis]));
  };
  add(faces.initial);
  for (const double time : times)
    add(sleeve_places(faces, nearest(run.sleeve, time)));
  meta["sleeve"] = {{"corners", corners.size()}, {"faces", outer}};
}

// Strain and stress of the sample nearest to a time.
std::string words_at(const Run &run, double time) {
  const std::vector<double> &times = run.history.column("time_s");
  std::size_t row = 0;
  for (std::size_t k = 0; k < times.size(); ++k)
    if (std::abs(times[k] - time) < std::abs(times[row] - time)) row = k;
  return fmt::format("strain {:.2f} mm/m, stress {:.1f} MPa", 1e3 * run.strain()[row],
                     1e-6 * run.stress()[row]);
}

std::size_t frame_nearest(const FrameSeries &series, double time) {
  return static_cast<std::size_t>(&nearest(series, time) - series.data());
}

} // namespace

std::vector<std::size_t> frames_to_show(std::size_t count, std::size_t most,
                                        std::vector<std::size_t> wanted) {
  std::vector<std::size_t> shown(count);
  std::iota(shown.begin(), shown.end(), 0);
  if (count <= most) return shown;
  wanted.insert(wanted.end(), {0, count - 1});
  // Evenly, with as many between as leave room for what is wanted besides.
  for (std::size_t between = most;; --between) {
    shown = wanted;
    for (std::size_t k = 0; k < between; ++k)
      shown.push_back(between == 1 ? 0 : k * (count - 1) / (between - 1));
    std::sort(shown.begin(), shown.end());
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    if (shown.size() <= most) return shown;
  }
}

SpecimenView pack_view(const Run &run, const Extent &extent, std::size_t most_frames) {
  const std::vector<std::size_t> shown = frames_to_show(
      run.specimen.size(), most_frames,
      {frame_nearest(run.specimen, run.moments.peak_time), frame_nearest(run.specimen, run.pattern_time())});
  const Spheres first = read_spheres(run.specimen.front());
  const Box box = box_of(extent);
  const double largest = *std::max_element(first.radius.begin(), first.radius.end());
  const Steps radii{0, largest / largest_16 * 4}; // areas of bonds may be larger than spheres

  SpecimenView view;
  Bytes bytes(view.bytes);
  for (const double radius : first.radius)
    bytes.two(radii.of(radius));
  Json frames = Json::array();
  std::vector<double> times;
  for (const std::size_t k : shown) {
    const Frame &frame = run.specimen[k];
    const Spheres spheres = read_spheres(frame);
    if (spheres.id != first.id)
      throw InputError(frame.parts.front().string() + ": holds other spheres than the first frame");
    add_frame(spheres, box, bytes);
    times.push_back(frame.time);
    frames.push_back({{"time_s", frame.time},
                      {"words", words_at(run, frame.time)},
                      {"platens", platens_at(run, frame.time)}});
  }
  const std::vector<Crack> cracks =
      run.cracks ? cracks_until(*run.cracks, times.back(), first) : std::vector<Crack>{};
  add_cracks(cracks, times, box, radii, bytes);

  const auto start = std::lower_bound(times.begin(), times.end(),
                                      run.specimen[frame_nearest(run.specimen, run.pattern_time())].time);
  view.meta = {{"spheres", first.size()},
               {"cracks", cracks.size()},
               {"radius_step", radii.step},
               {"step", box.steps[0].step},
               {"origin", {box.steps[0].origin, box.steps[1].origin, box.steps[2].origin}},
               {"low", box.low},
               {"high", box.high},
               {"plane", extent.is_plane()},
               {"pieces", !first.fragment.empty()},
               {"start_frame", start - times.begin()},
               {"ids", first.id},
               {"frames", frames}};
  if (!run.sleeve.empty()) add_sleeve(run, times, box, view.meta, bytes);
  return view;
}

std::string specimen_view_html(const Run &run, const Extent &extent) {
  constexpr std::size_t most_frames = 20;
  const SpecimenView view = pack_view(run, extent, most_frames);
  std::string html(viewer_html);
  const auto fill = [&html](const std::string &name, const std::string &text) {
    const std::size_t at = html.find(name);
    html.replace(at, name.size(), text);
  };
  fill("@META@", view.meta.dump());
  fill("@DATA@", base64(view.bytes));
  fill("@PROGRAM@", std::string(viewer_program));
  return html;
}

} // namespace platen::apps::report
