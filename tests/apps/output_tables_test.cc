// Tables of spheres, of ids and of cracks: read back to the bit, refused by line and column.
#include <cstring>
#include <fstream>
#include <limits>
#include <locale>
#include <random>

#include "apps/output/crack_discs.h"
#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "apps/output/specimen_csv.h"
#include "apps/scene/errors.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class SpecimenCsv : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "specimen.csv";
  SpecimenFile read(const std::string &content) const {
    put(path_, content);
    return read_specimen_csv(path_);
  }
  std::string refusal(const std::string &content) const {
    put(path_, content);
    return message_of<InputError>([&] { read_specimen_csv(path_); });
  }
};

dem::Specimen random_specimen(std::size_t n) {
  dem::Specimen specimen;
  specimen.shape.kind = dem::ShapeKind::cylinder;
  specimen.shape.radius = 0.1 / 3;
  specimen.shape.height = 0.1 + 0.2;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  for (std::size_t k = 0; k < n; ++k) {
    specimen.centre.push_back({uniform(random), uniform(random), uniform(random) + 0.05});
    specimen.radius.push_back(1e-3 * (1.5 + 10 * uniform(random)));
  }
  specimen.centre[0] = {-0.0, std::numeric_limits<double>::denorm_min(), 1e300};
  return specimen;
}

void expect_same_bits(const dem::Specimen &a, const dem::Specimen &b) {
  EXPECT_EQ(a.shape.kind, b.shape.kind);
  EXPECT_EQ(a.shape.radius, b.shape.radius);
  EXPECT_EQ(a.shape.width_x, b.shape.width_x);
  EXPECT_EQ(a.shape.width_y, b.shape.width_y);
  EXPECT_EQ(a.shape.height, b.shape.height);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.radius.size(), b.radius.size());
  EXPECT_EQ(std::memcmp(a.centre.data(), b.centre.data(), a.size() * sizeof(Vector3)), 0);
  EXPECT_EQ(std::memcmp(a.radius.data(), b.radius.data(), a.size() * sizeof(double)), 0);
}

TEST_F(SpecimenCsv, reads_back_to_the_same_bits) {
  dem::Specimen specimen = random_specimen(20000); // more than is written at once
  write_specimen_csv(path_, specimen);
  SpecimenFile back = read_specimen_csv(path_);
  EXPECT_TRUE(back.states_shape);
  expect_same_bits(back.specimen, specimen);
  specimen.shape = {dem::ShapeKind::box, 0, 0.01 / 3, 0.02, 0.7};
  write_specimen_csv(path_, specimen);
  expect_same_bits(read_specimen_csv(path_).specimen, specimen);
}

TEST_F(SpecimenCsv, is_the_text_that_the_documentation_states) {
  dem::Specimen specimen;
  specimen.shape.radius = 0.025;
  specimen.shape.height = 0.1;
  specimen.centre = {{0.001, -0.0024, 0.0013}};
  specimen.radius = {0.0012};
  write_specimen_csv(path_, specimen);
  EXPECT_EQ(content_of(path_),
            "# shape: cylinder radius_m=0.025 height_m=0.1\n"
            "x_m,y_m,z_m,radius_m\n"
            "0.001,-0.0024,0.0013,0.0012\n");
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_F(SpecimenCsv, is_the_same_where_decimals_have_a_comma) {
  const dem::Specimen specimen = random_specimen(100);
  write_specimen_csv(path_, specimen);
  const std::string plain = content_of(path_);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  write_specimen_csv(path_, specimen);
  const SpecimenFile back = read_specimen_csv(path_);
  std::locale::global(before);
  EXPECT_EQ(content_of(path_), plain);
  expect_same_bits(back.specimen, specimen);
}

TEST_F(SpecimenCsv, from_elsewhere_is_read) {
  const SpecimenFile file = read(
      "\xef\xbb\xbf# made by hand\r\n\r\nx_m,y_m,z_m,radius_m\r\n"
      " 1 , +2,\t3.5e-1,1e-3\r\n# a remark\r\n4,5,6,2E-3"); // no line end
  EXPECT_FALSE(file.states_shape);
  ASSERT_EQ(file.specimen.size(), 2u);
  EXPECT_EQ(file.specimen.centre[0].y, 2);
  EXPECT_EQ(file.specimen.centre[0].z, 0.35);
  EXPECT_EQ(file.specimen.radius[1], 2e-3);
}

TEST_F(SpecimenCsv, faults_are_refused_with_line_column_and_value) {
  const std::string header = "x_m,y_m,z_m,radius_m\n";
  struct Fault {
    std::string content;
    std::vector<std::string> words; // all in the message
  };
  const std::vector<Fault> faults{
      {header + "1,2,3,0.1\n1,zwei,3,0.1\n", {":3:", "y_m", "\"zwei\""}},
      {header + "1,2,3,0.1mm\n", {":2:", "radius_m", "\"0.1mm\""}},
      {header + "1,2,,0.1\n", {":2:", "z_m", "\"\""}},
      {header + "1,2,nan,0.1\n", {":2:", "z_m", "nan"}},
      {header + "inf,2,3,0.1\n", {":2:", "x_m", "inf"}},
      {header + "1e999,2,3,0.1\n", {":2:", "x_m", "1e999"}},
      {header + "+-1,2,3,0.1\n", {":2:", "x_m", "+-1"}},
      {header + "1,2,3,0\n", {":2:", "radius_m", "positive"}},
      {header + "1,2,3,-0.5\n", {":2:", "radius_m", "-0.5"}},
      {header + "1,2,3\n", {":2:", "a row has 3 values, the header names 4"}},
      {header + "1,2,3,4,5\n", {":2:", "a row has 5 values"}},
      {header + "1;2;3;4\n", {":2:", "a row has 1 value,"}},
      {"1,2,3,0.1\n", {":1:", "header", "x_m,y_m,z_m,radius_m"}},
      {"x,y,z,s\n1,2,3,0.1\n", {":1:", "header", "\"x, y, z, s\""}},
      {header, {"no sphere"}},
      {"", {"no sphere"}},
      {"# shape: cone radius_m=1 height_m=2\n" + header, {":1:", "cone", "cylinder, box"}},
      {"# shape: cylinder radius_m=1\n" + header, {":1:", "height_m", "missing"}},
      {"# shape: cylinder radius_m=1 height_m=-2\n" + header, {":1:", "height_m=-2"}},
      {"# shape: cylinder radius_m=1 height_m=2 width_x_m=3\n" + header, {":1:", "width_x_m=3"}},
      {"# shape: cylinder radius_m=1 radius_m=1 height_m=2\n" + header, {":1:", "radius_m=1"}},
      {"# shape: box width_x_m height_m=2\n" + header, {":1:", "width_x_m"}},
      {std::string(100000, '\xff'), {":1:", "header"}}};
  for (const Fault &fault : faults) {
    const std::string text = refusal(fault.content);
    EXPECT_TRUE(contains(text, path_.string()));
    EXPECT_LT(text.size(), path_.string().size() + 250);
    for (const std::string &word : fault.words)
      EXPECT_TRUE(contains(text, word)) << "no "
                                        << " in: ";
  }
}

TEST_F(SpecimenCsv, that_is_not_there_is_refused) {
  EXPECT_TRUE(contains(message_of<InputError>([&] { read_specimen_csv(path_); }), path_.string()));
  EXPECT_TRUE(contains(message_of<InputError>([&] { read_specimen_csv(folder_); }), folder_.string()));
}

TEST_F(SpecimenCsv, on_a_full_disk_says_so) {
  fs::create_symlink("/dev/full", part_path(path_));
  EXPECT_THROW(write_specimen_csv(path_, random_specimen(10)), OutputError);
  EXPECT_FALSE(fs::exists(path_));
}

class IdList : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "aggregate.txt";
  std::vector<int> read(const std::string &content) const {
    put(path_, content);
    return read_id_list(path_);
  }
  std::string refusal(const std::string &content) const {
    put(path_, content);
    return message_of<InputError>([&] { read_id_list(path_); });
  }
};

TEST_F(IdList, holds_one_number_a_line_between_comments) {
  EXPECT_EQ(read("# large ones\r\n3\n\n  0 # the first\n2147483647"), (std::vector<int>{3, 0, 2147483647}));
  EXPECT_TRUE(read("# none\n").empty());
}

TEST_F(IdList, refuses_what_is_no_id) {
  for (const char *bad : {"1.5", "-1", "1 2", "1,2", "a", "2147483648", "0x1", "+1"}) {
    const std::string message = refusal(std::string("7\n") + bad + "\n");
    EXPECT_TRUE(contains(message, "aggregate.txt:2: error: \"" + std::string(bad) + "\" is no id"));
  }
  EXPECT_TRUE(contains(refusal("7\n8\n\n7\n"), "aggregate.txt:4: error: 7 stands in line 1 too"));
  put(path_, "0\n9\n\n10\n");
  EXPECT_EQ(read_id_list(path_, 11).size(), 3u);
  EXPECT_TRUE(
      contains(message_of<InputError>([&] { read_id_list(path_, 10); }),
               "aggregate.txt:4: error: names sphere 10, but the specimen has 10. Allowed: 0 ... 9."));
  EXPECT_TRUE(contains(message_of<InputError>([&] { read_id_list(folder_ / "none"); }), "cannot be read"));
  EXPECT_TRUE(contains(message_of<InputError>([&] { read_id_list(folder_); }), "cannot be read"));
}

const char *crack_header =
    "time_s,axial_strain,x_m,y_m,z_m,nx,ny,nz,area_m2,mode,energy_j,particle_a,particle_b\n";

class CrackDiscs : public ScratchFolder {
protected:
  void write(const std::string &rows) { std::ofstream(folder_ / "cracks.csv") << crack_header << rows; }
  void discs() { write_crack_discs(folder_ / "cracks.csv", 1, folder_ / "cracks.vtu"); }
};

TEST_F(CrackDiscs, are_the_same_bytes_each_time_and_none_is_a_file_too) {
  write("1e-3,0.002,0,0,0.01,0,0,1,1e-6,tension,2e-6,3,4\n");
  discs();
  const std::string first = content_of(folder_ / "cracks.vtu");
  discs();
  EXPECT_EQ(first, content_of(folder_ / "cracks.vtu"));
  EXPECT_TRUE(contains(first, "NumberOfPoints=\"12\""));
  write("");
  discs();
  EXPECT_TRUE(contains(content_of(folder_ / "cracks.vtu"), "NumberOfCells=\"0\""));
}

TEST_F(CrackDiscs, a_damaged_row_is_named) {
  write("1e-3,0.002,0,0,0.01,0,0,1,1e-6,bending,2e-6,3,4\n");
  EXPECT_TRUE(contains(message_of<InputError>([&] { discs(); }), "cracks.csv:2: mode: \"bending\""));
  write("1e-3,0.002,0,0\n");
  EXPECT_TRUE(contains(message_of<InputError>([&] { discs(); }), ":2: 4 fields, 13 are wanted"));
  write("1e-3,0.002,0,x,0.01,0,0,1,1e-6,shear,2e-6,3,4\n");
  EXPECT_TRUE(contains(message_of<InputError>([&] { discs(); }), "y_m: \"x\" is not a number"));
}

} // namespace
} // namespace platen::apps
