// platen-report as a user runs it: exit statuses, messages, and what its pictures show.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/output/file.h"
#include "apps/report/embedded.h"
#include "apps/report_example.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

struct Outcome {
  int status = -1;
  std::string out, error;
};

// Runs the program by the shell, with `setting` before it ("VARIABLE=value").
Outcome run(const TestFolder &folder, const std::string &arguments, const std::string &setting = "") {
  const std::string out = (folder / "out.txt").string(), error = (folder / "error.txt").string();
  const std::string command =
      setting + " '" PLATEN_REPORT_PROGRAM "' " + arguments + " >'" + out + "' 2>'" + error + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(error)};
}

std::string quoted(const std::filesystem::path &path) {
  return "'" + path.string() + "'";
}

struct Image {
  vtkSmartPointer<vtkImageData> data;
  int width = 0, height = 0;
  double at(int x, int y, int channel) const { return data->GetScalarComponentAsDouble(x, y, 0, channel); }
};

Image read_png(const std::filesystem::path &file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  Image image{reader->GetOutput()};
  image.width = image.data->GetDimensions()[0];
  image.height = image.data->GetDimensions()[1];
  return image;
}

// Share of pixels that are not white.
double inked(const Image &image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      count += image.at(x, y, 0) < 250 || image.at(x, y, 1) < 250 || image.at(x, y, 2) < 250 ? 1 : 0;
  return static_cast<double>(count) / image.width / image.height;
}

// Mean of red less the mean of green and blue over a square of 80 pixels about (x, y), fractions.
double redness(const Image &image, double x, double y) {
  const int cx = static_cast<int>(x * image.width), cy = static_cast<int>(y * image.height), half = 40;
  double sum = 0;
  for (int j = cy - half; j < cy + half; ++j)
    for (int i = cx - half; i < cx + half; ++i)
      sum += image.at(i, j, 0) - 0.5 * (image.at(i, j, 1) + image.at(i, j, 2));
  return sum / (4.0 * half * half);
}

double greenness(const Image &image, double x, double y) {
  const int cx = static_cast<int>(x * image.width), cy = static_cast<int>(y * image.height), half = 20;
  double sum = 0;
  for (int j = cy - half; j < cy + half; ++j)
    for (int i = cx - half; i < cx + half; ++i)
      sum += image.at(i, j, 1);
  return sum / (4.0 * half * half);
}

TEST(ReportApp, every_picture_is_drawn_without_a_display_and_is_neither_empty_nor_black) {
  const TestFolder folder;
  write_example(folder / "dry", {});
  const Outcome outcome = run(folder, quoted(folder / "dry"), "env -u DISPLAY");
  ASSERT_EQ(outcome.status, status_done) << outcome.error;
  for (const char *name :
       {"stress_strain", "energies", "outward_displacement", "damage", "cracks", "crack_density", "fragments",
        "cones", "crack_times", "specimen_outside", "specimen_inside"}) {
    const auto file = folder / "dry" / "pictures" / (std::string(name) + ".png");
    ASSERT_TRUE(std::filesystem::exists(file)) << name;
    const Image image = read_png(file);
    EXPECT_GE(image.width, 1000) << name;
    EXPECT_GT(inked(image), 0.01) << name;
    EXPECT_LT(inked(image), 0.75) << name;
    EXPECT_GT(image.at(2, 2, 0) + image.at(2, image.height - 3, 0), 509) << name << ": corners are white";
  }
  EXPECT_NE(outcome.out.find("strength (MPa)"), std::string::npos);
  const std::string page = text_of(folder / "dry" / "pictures" / "report.html");
  EXPECT_NE(page.find("dry platens"), std::string::npos);
  EXPECT_NE(page.find("on top 45 degrees (confidence 0.80), at the bottom 30 degrees"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,iVBOR"), std::string::npos); // how every PNG begins
}

// The apex stands aside along x, the axis leans along y: by which of both the specimen is turned must not
// hang on its size.
TEST(ReportApp, cones_look_the_same_at_any_size) {
  const TestFolder folder;
  const auto picture_of = [&](double times) {
    const auto of = folder / fmt::format("times {:g}", times);
    ExampleRun example;
    example.radius *= times, example.height *= times, example.spacing *= times;
    write_example(of, example);
    nlohmann::json summary = nlohmann::json::parse(text_of(of / "summary.json"));
    for (const char *key : {"cone_top", "cone_bottom"}) {
      summary[key]["apex_m"][0] = 0.008 * times;
      summary[key]["axis"][1] = 0.3;
      summary[key]["axis"][2] = (std::string(key) == "cone_top" ? 1 : -1) * std::sqrt(1 - 0.3 * 0.3);
    }
    std::ofstream(of / "summary.json") << summary.dump();
    const Outcome outcome = run(folder, quoted(of), "env -u DISPLAY");
    EXPECT_EQ(outcome.status, status_done) << outcome.error;
    return read_png(of / "pictures" / "cones.png");
  };
  const Image first = picture_of(1);
  for (const double times : {10.0, 0.1}) {
    const Image other = picture_of(times);
    ASSERT_EQ(other.width, first.width);
    ASSERT_EQ(other.height, first.height);
    int differ = 0;
    for (int y = 0; y < first.height; ++y)
      for (int x = 0; x < first.width; ++x)
        differ += std::abs(first.at(x, y, 0) - other.at(x, y, 0)) > 40 ||
                  std::abs(first.at(x, y, 2) - other.at(x, y, 2)) > 40;
    EXPECT_LT(differ, 0.002 * first.width * first.height) << times; // but for edges of spheres
  }
}

// Shaded: smooth, of which a PNG is large and a JPEG small. Flat: as a chart.
TEST(ReportApp, pictures_of_spheres_are_embedded_as_jpeg_and_charts_as_they_are) {
  const TestFolder folder;
  const auto write = [&](const char *name, bool shaded) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(300, 200, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 300; ++x)
        for (int c = 0; c < 3; ++c)
          image->SetScalarComponentFromDouble(
              x, y, 0, c,
              shaded ? 128 + 100 * std::sin(x / 17. + c) * std::cos(y / 23.) : (y == 50 ? 0 : 255));
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName((folder / name).c_str());
    writer->SetInputData(image);
    writer->Write();
    return source_of_picture(folder / name);
  };
  EXPECT_EQ(write("flat.png", false).rfind("data:image/png;base64,iVBOR", 0), 0);
  const std::string shaded = write("shaded.png", true), head = "data:image/jpeg;base64,";
  ASSERT_EQ(shaded.rfind(head + "/9j/", 0), 0) << shaded.substr(0, 40);
  EXPECT_LT(shaded.size() - head.size(), 2 * std::filesystem::file_size(folder / "shaded.png") / 3 + 4);
  folder.write("shaded.base64", shaded.substr(head.size()));
  ASSERT_EQ(
      std::system(
          ("base64 -d " + quoted(folder / "shaded.base64") + " > " + quoted(folder / "shaded.jpg")).c_str()),
      0);
  vtkNew<vtkJPEGReader> reader;
  reader->SetFileName((folder / "shaded.jpg").c_str());
  reader->Update();
  const Image jpeg{reader->GetOutput(), 300, 200}, png = read_png(folder / "shaded.png");
  double most = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x)
      for (int c = 0; c < 3; ++c)
        most = std::max(most, std::abs(jpeg.at(x, y, c) - png.at(x, y, c)));
  EXPECT_LT(most, 12) << "of 255: turned over or in other colours it were 100";
}

TEST(ReportApp, a_picture_that_cannot_be_read_back_is_told) {
  const TestFolder folder;
  EXPECT_THROW(source_of_picture(folder / "none.png"), OutputError);
}

TEST(ReportApp, compared_side_by_side_the_hourglass_is_red_in_the_middle_and_the_other_at_its_ends) {
  const TestFolder folder;
  ExampleRun lubricated;
  lubricated.hourglass = false;
  write_example(folder / "dry", {});
  write_example(folder / "lubricated", lubricated);
  const Outcome outcome = run(folder, quoted(folder / "dry") + " --compare " + quoted(folder / "lubricated") +
                                          " -o " + quoted(folder / "somewhere else"));
  ASSERT_EQ(outcome.status, status_done) << outcome.error;
  EXPECT_NE(outcome.out.find("dry / lubricated"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "dry" / "pictures"));

  const Image image = read_png(folder / "somewhere else" / "comparison_damage.png");
  const double dry = 0.21, other = 0.64, middle = 0.5, end = 0.2; // places in the picture
  constexpr double clearly = 60; // of 255; intact spheres are grey (0), broken ones dark red (100 and more)
  EXPECT_GT(redness(image, dry, middle), redness(image, dry, end) + clearly);
  EXPECT_GT(redness(image, other, end), redness(image, other, middle) + clearly);
  EXPECT_TRUE(std::filesystem::exists(folder / "somewhere else" / "comparison_stress_strain.png"));

  // Outward displacement: from dark violet (green 1) over green to yellow (231); largest at the skin.
  const Image moved = read_png(folder / "somewhere else" / "comparison_displacement.png");
  constexpr double to_the_skin = 0.06, brighter = 40;
  EXPECT_GT(greenness(moved, dry + to_the_skin, middle), greenness(moved, dry + to_the_skin, end) + brighter);
  EXPECT_GT(greenness(moved, other + to_the_skin, end),
            greenness(moved, other + to_the_skin, middle) + brighter);
}

TEST(ReportApp, on_a_full_disk_former_pictures_and_page_stay) {
  const TestFolder folder;
  write_example(folder / "dry", {});
  for (const char *name : {"specimen.pvd", "bonds.pvd", "platens.pvd"})
    std::filesystem::remove(folder / "dry" / name);
  ASSERT_EQ(run(folder, quoted(folder / "dry")).status, status_done);
  for (const std::string name : {"energies.png", "report.html"}) {
    // The next one is written through a name that leads to a device without room.
    const auto file = folder / "dry" / "pictures" / name, part = part_path(file);
    const std::string former = text_of(file);
    std::filesystem::create_symlink("/dev/full", part);
    const Outcome outcome = run(folder, quoted(folder / "dry") + " --quiet");
    EXPECT_EQ(outcome.status, status_output);
    EXPECT_EQ(outcome.error, "error: " + part.string() + ": cannot be written: No space left on device\n");
    EXPECT_EQ(text_of(file), former);
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(part)));
  }
}

TEST(ReportApp, a_run_without_frames_still_gets_its_curves) {
  const TestFolder folder;
  write_example(folder / "dry", {});
  for (const char *name : {"specimen.pvd", "bonds.pvd", "platens.pvd", "summary.json"})
    std::filesystem::remove(folder / "dry" / name);
  const Outcome outcome = run(folder, quoted(folder / "dry"));
  ASSERT_EQ(outcome.status, status_done) << outcome.error;
  EXPECT_NE(outcome.out.find("specimen.pvd is not there"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "dry" / "pictures" / "energies.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "dry" / "pictures" / "damage.png"));
}

TEST(ReportApp, bad_input_ends_with_status_two_one_line_and_no_picture) {
  const TestFolder folder;
  write_example(folder / "dry", {});
  const Outcome missing = run(folder, quoted(folder / "nowhere"));
  EXPECT_EQ(missing.status, status_bad_input);
  EXPECT_NE(missing.error.find("no such folder"), std::string::npos);
  EXPECT_EQ(run(folder, "").status, status_bad_input);
  EXPECT_EQ(run(folder, quoted(folder / "dry") + " --colour red").status, status_bad_input);
  const Outcome no_stress = run(folder, quoted(folder / "dry") + " --fields"); // its frames tell none
  EXPECT_EQ(no_stress.status, status_bad_input);
  EXPECT_NE(no_stress.error.find("specimen.pvd with stress"), std::string::npos);

  folder.write("dry/history.csv", "time_s,axial_stress_top_pa\n0,zero\n");
  const Outcome damaged = run(folder, quoted(folder / "dry"));
  EXPECT_EQ(damaged.status, status_bad_input);
  EXPECT_NE(damaged.error.find("history.csv:2"), std::string::npos);
  EXPECT_EQ(std::count(damaged.error.begin(), damaged.error.end(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(folder / "dry" / "pictures"));
}

TEST(ReportApp, without_display_and_xvfb_it_says_what_to_install) {
  const TestFolder folder;
  write_example(folder / "dry", {});
  const Outcome outcome = run(folder, quoted(folder / "dry"), "env -u DISPLAY PATH=/nonexistent");
  EXPECT_EQ(outcome.status, status_bad_input);
  EXPECT_NE(outcome.error.find("xvfb"), std::string::npos) << outcome.error;
}

TEST(ReportApp, a_folder_that_cannot_be_made_ends_with_status_four) {
  const TestFolder folder;
  write_example(folder / "dry", {});
  const auto file = folder.write("file", "in the way");
  const Outcome outcome = run(folder, quoted(folder / "dry") + " -o " + quoted(file / "pictures"));
  EXPECT_EQ(outcome.status, status_output) << outcome.error;
}

TEST(ReportApp, help_and_version_end_with_status_zero) {
  const TestFolder folder;
  EXPECT_EQ(run(folder, "--help").status, status_done);
  const Outcome version = run(folder, "--version");
  EXPECT_EQ(version.status, status_done);
  EXPECT_NE(version.out.find("VTK"), std::string::npos);
}

} // namespace
} // namespace platen::apps::report
