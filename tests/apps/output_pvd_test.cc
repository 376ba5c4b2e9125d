#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <limits>

#include "apps/output/errors.h"
#include "apps/output/output_folder.h"
#include "apps/output/pvd.h"
#include "apps/output/vtu.h"
#include "scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class Pvd : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "specimen.pvd";
  static double time_of(int k) { return 1e-4 * k / 3; }
  void frame(PvdSeries &series, int k) const {
    const std::string name = OutputPaths::frame_name("specimen", k);
    fs::create_directories((folder_ / name).parent_path());
    write_points(folder_ / name, time_of(k), {{0, 0, 0.01 * k}}, {});
    series.append(time_of(k), name);
  }
  // Files that are listed, with their times, as ParaView reads them.
  std::vector<std::pair<double, std::string>> listed() const {
    std::vector<std::pair<double, std::string>> frames;
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path_.c_str()));
    if (!root) return frames;
    EXPECT_STREQ(root->GetAttribute("type"), "Collection");
    vtkXMLDataElement *collection = root->FindNestedElementWithName("Collection");
    for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
      vtkXMLDataElement *entry = collection->GetNestedElement(k);
      frames.emplace_back(std::stod(entry->GetAttribute("timestep")), entry->GetAttribute("file"));
    }
    return frames;
  }
};

TEST_F(Pvd, lists_every_frame_with_its_time_after_each_one) {
  PvdSeries series(path_);
  EXPECT_FALSE(fs::exists(path_));
  for (int k = 0; k < 4; ++k) {
    frame(series, k);
    const auto frames = listed();
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(k) + 1);
    EXPECT_EQ(frames.back().first, time_of(k));
    EXPECT_TRUE(fs::exists(folder_ / frames.back().second));
  }
}

TEST_F(Pvd, of_a_resumed_run_equals_that_of_an_uninterrupted_one) {
  {
    PvdSeries series(path_);
    for (int k = 0; k < 10; ++k)
      frame(series, k);
  }
  const std::string whole = content_of(path_);
  for (const int last : {9, 5, 0}) {
    PvdSeries series(path_);
    series.resume(time_of(last)); // a checkpoint at the very time of a frame: the frame stays
    ASSERT_EQ(listed().size(), static_cast<std::size_t>(last) + 1);
    for (int k = last + 1; k < 10; ++k)
      frame(series, k);
    EXPECT_EQ(content_of(path_), whole);
  }
}

TEST_F(Pvd, resumed_before_its_first_frame_starts_anew) {
  {
    PvdSeries series(path_);
    frame(series, 1);
  }
  PvdSeries series(path_);
  series.resume(0);
  EXPECT_TRUE(listed().empty());
  fs::remove(path_);
  PvdSeries none(path_);
  EXPECT_NO_THROW(none.resume(1));
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Pvd, that_cannot_go_on_is_refused) {
  {
    PvdSeries series(path_);
    frame(series, 0);
    frame(series, 1);
  }
  const std::string whole = content_of(path_);
  const auto refused = [&] {
    PvdSeries series(path_);
    const std::string text = message_of<CheckpointError>([&] { series.resume(1); });
    EXPECT_TRUE(contains(text, path_.string())) << text;
    return text;
  };
  put(path_, whole.substr(0, whole.size() / 2));
  refused();
  put(path_, whole);
  fs::remove(folder_ / OutputPaths::frame_name("specimen", 0));
  EXPECT_TRUE(contains(refused(), "specimen_000000.vtu"));
}

TEST_F(Pvd, goes_forward_in_time_and_numbers_the_parts_of_a_frame) {
  PvdSeries series(path_);
  series.append(1, "top.vtu");
  series.append(1, "bottom.vtu");
  EXPECT_THROW(series.append(0.5, "late.vtu"), std::logic_error);
  EXPECT_THROW(series.append(std::numeric_limits<double>::quiet_NaN(), "never.vtu"), std::logic_error);
  EXPECT_EQ(listed().size(), 2u);
  EXPECT_TRUE(contains(content_of(path_), "part=\"0\" file=\"top.vtu\""));
  EXPECT_TRUE(contains(content_of(path_), "part=\"1\" file=\"bottom.vtu\""));
}

TEST_F(Pvd, on_a_full_disk_stays_as_it_was) {
  PvdSeries series(path_);
  frame(series, 0);
  const std::string before = content_of(path_);
  fs::create_symlink("/dev/full", folder_ / "specimen.part.pvd");
  EXPECT_THROW(series.append(1, "next.vtu"), OutputError);
  EXPECT_EQ(content_of(path_), before);
}

} // namespace
} // namespace platen::apps
