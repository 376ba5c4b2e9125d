// The specimen that is turned on a report's page: which frames it holds, and that the packed numbers are
// those of the run.
#include "apps/report/viewer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/report/base64.h"
#include "apps/report/cracks.h"
#include "base/pi.h"
#include "report_example.h"
#include "report_folder.h"

namespace platen::apps::report {
namespace {

TEST(ReportViewer, all_frames_are_shown_where_there_is_room) {
  EXPECT_EQ(frames_to_show(4, 20, {1, 2}), (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(ReportViewer, of_many_frames_the_first_the_last_and_those_asked_for_stay) {
  for (const std::size_t count : {21u, 30u, 100u, 101u, 1000u})
    for (const std::size_t wanted : {3u, 11u, 19u}) {
      const std::vector<std::size_t> shown = frames_to_show(count, 20, {wanted, count - 2});
      EXPECT_LE(shown.size(), 20u) << count << " frames";
      EXPECT_GE(shown.size(), 17u) << count << " frames";
      EXPECT_TRUE(std::is_sorted(shown.begin(), shown.end()));
      EXPECT_EQ(std::adjacent_find(shown.begin(), shown.end()), shown.end()) << "one twice of " << count;
      EXPECT_EQ(shown.front(), 0u);
      EXPECT_EQ(shown.back(), count - 1);
      for (const std::size_t k : {wanted, count - 2})
        EXPECT_TRUE(std::binary_search(shown.begin(), shown.end(), k)) << k << " of " << count;
      for (std::size_t k = 1; k < shown.size(); ++k)
        EXPECT_LE(shown[k] - shown[k - 1], count / 15 + 1) << "a gap before " << shown[k] << " of " << count;
    }
}

// Reads the packed bytes in their order.
class Reader {
public:
  explicit Reader(const std::vector<unsigned char> &bytes) : bytes_(bytes) {}
  int one() { return bytes_.at(at_++); }
  int signed_one() {
    const int value = one();
    return value < 128 ? value : value - 256;
  }
  int two() {
    const int low = one();
    return low + 256 * one();
  }
  bool at_end() const { return at_ == bytes_.size(); }

private:
  const std::vector<unsigned char> &bytes_;
  std::size_t at_ = 0;
};

struct Packed {
  explicit Packed(const TestFolder &folder) {
    write_example(folder / "run", {});
    run = read_run(folder / "run");
    spheres = read_spheres(run.specimen.front());
    extent = extent_of(spheres);
    view = pack_view(run, extent, 20);
  }
  Run run;
  Spheres spheres;
  Extent extent;
  SpecimenView view;
};

TEST(ReportViewer, places_damage_and_radii_come_back_within_a_step) {
  const TestFolder folder;
  const Packed packed(folder);
  const Json &meta = packed.view.meta;
  const double step = meta["step"], radius_step = meta["radius_step"];
  EXPECT_LT(step, 3e-6); // 0.1 mm would be the displacements that it shows
  ASSERT_EQ(meta["frames"].size(), packed.run.specimen.size());
  Reader reader(packed.view.bytes);
  for (const double radius : packed.spheres.radius)
    EXPECT_NEAR(reader.two() * radius_step, radius, 0.51 * radius_step);
  for (const Frame &frame : packed.run.specimen) {
    const Spheres now = read_spheres(frame);
    for (const Position &place : now.position)
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(meta["origin"][axis].get<double>() + step * reader.two(), place[axis], 0.51 * step)
            << "time " << frame.time << ", axis " << axis;
    for (std::size_t k = 0; k < now.size(); ++k)
      ASSERT_NEAR(reader.one() / 255.0, now.damage(k), 0.51 / 255) << "sphere " << k;
    for (std::size_t k = 0; k < now.size(); ++k)
      ASSERT_EQ(reader.one(), now.fragment.empty() ? 0 : now.fragment[k]) << "sphere " << k;
  }
}

TEST(ReportViewer, cracks_come_with_the_first_frame_that_has_them) {
  const TestFolder folder;
  const Packed packed(folder);
  const Json &meta = packed.view.meta;
  const std::vector<Crack> cracks = cracks_until(*packed.run.cracks, example_end_time, packed.spheres);
  ASSERT_EQ(meta["cracks"], cracks.size());
  ASSERT_FALSE(cracks.empty());
  std::vector<unsigned char> tail(packed.view.bytes.end() - static_cast<std::ptrdiff_t>(13 * cracks.size()),
                                  packed.view.bytes.end());
  Reader reader(tail);
  for (const Crack &crack : cracks)
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(meta["origin"][axis].get<double>() + meta["step"].get<double>() * reader.two(),
                  crack.place[axis], 3e-6);
  for (const Crack &crack : cracks)
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(reader.signed_one() / 127.0, crack.normal[axis], 0.51 / 127);
  for (const Crack &crack : cracks)
    ASSERT_EQ(reader.one(), crack.in_tension ? 0 : 1);
  for (const Crack &crack : cracks)
    ASSERT_NEAR(pi * std::pow(reader.two() * meta["radius_step"].get<double>(), 2), crack.area,
                1e-3 * crack.area);
  for (const Crack &crack : cracks) {
    const int since = reader.one();
    EXPECT_GE(meta["frames"][since]["time_s"].get<double>(), crack.time);
    const double before = since == 0 ? -1 : meta["frames"][since - 1]["time_s"].get<double>();
    EXPECT_LT(before, crack.time);
  }
  EXPECT_TRUE(reader.at_end());
}

TEST(ReportViewer, it_opens_at_the_frame_in_which_the_pattern_is_told) {
  const TestFolder folder;
  const Packed packed(folder);
  const int start = packed.view.meta["start_frame"];
  EXPECT_EQ(packed.view.meta["frames"][start]["time_s"], example_fall_time);
  EXPECT_EQ(packed.view.meta["frames"][start]["words"], "strain 3.75 mm/m, stress 32.0 MPa");
}

// Ten thousand spheres and twenty frames: 8 bytes each, and 4 letters for 3 bytes.
TEST(ReportViewer, a_page_grows_by_eleven_bytes_a_sphere_and_frame) {
  const TestFolder folder;
  const Packed packed(folder);
  const std::size_t spheres = packed.spheres.size(), frames = packed.run.specimen.size(),
                    cracks = packed.view.meta["cracks"];
  EXPECT_EQ(packed.view.bytes.size(), 2 * spheres + 8 * spheres * frames + 13 * cracks);
  EXPECT_EQ(base64(packed.view.bytes).size(), (packed.view.bytes.size() + 2) / 3 * 4);
}

TEST(ReportViewer, the_element_needs_no_other_file) {
  const TestFolder folder;
  const Packed packed(folder);
  const std::string html = specimen_view_html(packed.run, packed.extent);
  for (const char *left : {"@META@", "@DATA@", "@PROGRAM@", "http:", "https:", "src=", "import "})
    EXPECT_EQ(html.find(left), std::string::npos) << left;
  EXPECT_NE(html.find(base64(packed.view.bytes)), std::string::npos);
}

} // namespace
} // namespace platen::apps::report
