// Frames in pieces: together they are the cloud, or the lines, as one file would hold them.
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include "apps/io/errors.h"
#include "apps/io/file.h"
#include "apps/io/output_folder.h"
#include "apps/io/pvd.h"
#include "apps/io/pvtu.h"
#include "io_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class Pvtu : public ScratchFolder {
protected:
  void SetUp() override {
    fs::create_directories(folder_ / "frames");
    for (std::size_t k = 0; k < rows_; ++k) {
      const auto x = static_cast<double>(k);
      points_.push_back({x, -2 * x, 0.5 * x * x});
      radius_.push_back(1 / (x + 1));
      id_.push_back(static_cast<int>(7 * k));
      if (k > 0) lines_.push_back({static_cast<int>(k), static_cast<int>(k * k % rows_)});
    }
    for (std::size_t k = 0; k < lines_.size(); ++k)
      force_.push_back(-3.5 * static_cast<double>(k));
  }
  std::vector<Field> fields_of_points() const {
    return {{"velocity", points_}, {"radius", radius_}, {"id", id_}};
  }
  std::vector<Field> fields_of_lines() const { return {{"force", force_}}; }
  void write_cloud() const {
    const Pieces pieces{rows_, 512};
    for (std::size_t piece = 0; piece < pieces.count(); ++piece)
      write_piece_of_points(path_, 0.25, points_, fields_of_points(), {{"axial_strain", 1e-3}}, pieces,
                            piece);
    write_pvtu(path_, 0.25, fields_of_points(), {}, {{"axial_strain", 1e-3}}, pieces.count());
  }
  vtkUnstructuredGrid *read() {
    reader_->SetFileName(path_.c_str());
    reader_->Update();
    EXPECT_EQ(reader_->GetErrorCode(), 0u);
    return reader_->GetOutput();
  }
  static constexpr std::size_t rows_ = 1200;
  std::vector<Vector3> points_;
  std::vector<double> radius_, force_;
  std::vector<int> id_;
  std::vector<std::array<int, 2>> lines_;
  const fs::path path_ = folder_ / OutputPaths::frame_of_pieces("specimen", 3);
  vtkNew<vtkXMLPUnstructuredGridReader> reader_;
};

TEST(Pieces, hold_every_row_once) {
  for (const std::size_t rows : {1, 511, 512, 513, 1024, 1200}) {
    const Pieces pieces{rows, 512};
    std::size_t next = 0;
    for (std::size_t piece = 0; piece < pieces.count(); ++piece) {
      EXPECT_EQ(pieces.begin(piece), next);
      EXPECT_GT(pieces.end(piece), next) << "an empty piece of " << rows;
      EXPECT_LE(pieces.end(piece) - next, 512u);
      next = pieces.end(piece);
    }
    EXPECT_EQ(next, rows);
  }
}

TEST_F(Pvtu, of_points_reads_back_as_one_cloud_in_their_order) {
  write_cloud();
  EXPECT_EQ(pieces_of(path_).size(), 3u);
  EXPECT_EQ(pieces_of(path_).back(), folder_ / "frames" / "specimen_000003_0002.vtu");
  vtkUnstructuredGrid *grid = read();
  ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(rows_));
  ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(rows_));
  ASSERT_EQ(grid->GetPointData()->GetNumberOfArrays(), 3);
  for (std::size_t k = 0; k < rows_; ++k) {
    const auto row = static_cast<vtkIdType>(k);
    ASSERT_EQ(grid->GetPoint(row)[2], points_[k].z);
    ASSERT_EQ(grid->GetPointData()->GetArray("velocity")->GetComponent(row, 1), points_[k].y);
    ASSERT_EQ(grid->GetPointData()->GetArray("radius")->GetComponent(row, 0), radius_[k]);
    ASSERT_EQ(grid->GetPointData()->GetArray("id")->GetComponent(row, 0), id_[k]);
  }
  EXPECT_EQ(grid->GetPointData()->GetArray("id")->GetDataType(), VTK_INT);
  EXPECT_STREQ(grid->GetPointData()->GetScalars()->GetName(), "radius");
}

TEST_F(Pvtu, of_lines_has_each_line_between_its_points) {
  const Pieces pieces{lines_.size(), 512};
  for (std::size_t piece = 0; piece < pieces.count(); ++piece)
    write_piece_of_lines(path_, 0.25, points_, lines_, fields_of_lines(), {}, pieces, piece);
  write_pvtu(path_, 0.25, {}, fields_of_lines(), {}, pieces.count());
  vtkUnstructuredGrid *grid = read();
  ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(lines_.size()));
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    vtkCell *cell = grid->GetCell(static_cast<vtkIdType>(k));
    for (int end = 0; end < 2; ++end)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(grid->GetPoint(cell->GetPointId(end))[c],
                  points_[static_cast<std::size_t>(lines_[k][static_cast<std::size_t>(end)])][c]);
    ASSERT_EQ(grid->GetCellData()->GetArray("force")->GetComponent(static_cast<vtkIdType>(k), 0), force_[k]);
  }
  lines_.back()[1] = static_cast<int>(rows_);
  EXPECT_THROW(write_piece_of_lines(path_, 0, points_, lines_, fields_of_lines(), {}, pieces, 2),
               std::logic_error);
}

// As a single file has them.
TEST_F(Pvtu, has_time_and_values_of_the_frame) {
  write_cloud();
  vtkFieldData *values = read()->GetFieldData();
  ASSERT_NE(values->GetArray("TimeValue"), nullptr);
  EXPECT_EQ(values->GetArray("TimeValue")->GetComponent(0, 0), 0.25);
  ASSERT_NE(values->GetArray("axial_strain"), nullptr);
  EXPECT_EQ(values->GetArray("axial_strain")->GetComponent(0, 0), 1e-3);
}

TEST_F(Pvtu, without_one_of_its_pieces_is_refused_by_a_resumed_run) {
  write_cloud();
  const fs::path pvd = folder_ / "specimen.pvd";
  PvdSeries(pvd).append(0.25, OutputPaths::frame_of_pieces("specimen", 3));
  const std::string whole = content_of(path_);
  const auto refused = [&] { return message_of<CheckpointError>([&] { PvdSeries(pvd).resume(1); }); };
  EXPECT_NO_THROW(PvdSeries(pvd).resume(1));
  fs::remove(folder_ / "frames" / "specimen_000003_0001.vtu");
  EXPECT_EQ(
      refused(),
      pvd.string() + ": the frame frames/specimen_000003.pvtu lacks its piece specimen_000003_0001.vtu");
  put(path_, whole.substr(0, whole.size() / 2));
  EXPECT_EQ(refused(), pvd.string() + ": the frame frames/specimen_000003.pvtu is damaged");
}

TEST_F(Pvtu, on_a_full_disk_says_so) {
  fs::create_symlink("/dev/full", part_path(piece_path(path_, 1)));
  const std::string text = message_of<OutputError>([&] { write_cloud(); });
  EXPECT_TRUE(contains(text, "specimen_000003_0001.part.vtu") && contains(text, "No space left")) << text;
}

} // namespace
} // namespace platen::apps
