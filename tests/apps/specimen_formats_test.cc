// One lattice in the forms of several programs is the same to the last bit; wrong files are refused with what
// was expected.
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>

#include <fmt/format.h>

#include "apps/output/specimen_csv.h"
#include "apps/scene/errors.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing::formats {
namespace {

using Words = std::vector<std::string>;

// Lengths in hundredths of a millimetre, which no double but 0 holds in m.
constexpr int pitch = 131, radius = 65;

std::string decimal(int hundredths, int digits) {
  const int size = std::abs(hundredths), unit = static_cast<int>(std::lround(std::pow(10, digits)));
  return fmt::format("{}{}.{:0{}d}", hundredths < 0 ? "-" : "", size / unit, size % unit, digits);
}
std::string in_m(int hundredths) {
  return decimal(hundredths, 5);
}
std::string in_mm(int hundredths) {
  return decimal(hundredths, 2);
}
std::string with_comma(std::string text) {
  text.at(text.find('.')) = ',';
  return text;
}

// A lattice of 3 x 2 x 4 spheres, row by row.
std::string rows(const std::function<std::string(int number, int x, int y, int z)> &row) {
  std::string text;
  for (int k = 0; k < 24; ++k)
    text += row(k, (k % 3 - 1) * pitch, (k / 3 % 2) * pitch, radius + k / 6 * pitch) + '\n';
  return text;
}
std::string plain(const std::string &between) {
  return rows([&](int, int x, int y, int z) {
    return in_m(x) + between + in_m(y) + between + in_m(z) + between + in_m(radius);
  });
}

class SpecimenFormats : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "spheres.txt";
  SpecimenFile read(const std::string &content, const SpecimenForm &form = {}) const {
    put(path_, content);
    return read_specimen_file(path_, form);
  }
  SpecimenFile lattice() const { return read("x_m,y_m,z_m,radius_m\n" + plain(",")); }
  void expect_refused(const std::string &content, const Words &says, const SpecimenForm &form = {}) const {
    put(path_, content);
    const std::string text = message_of<InputError>([&] { read_specimen_file(path_, form); });
    EXPECT_TRUE(contains(text, path_.string())) << content;
    for (const std::string &words : says)
      EXPECT_TRUE(contains(text, words)) << content << "\nsays " << text;
  }
};

void expect_same_bits(const dem::Specimen &a, const dem::Specimen &b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.centre.data(), b.centre.data(), a.size() * sizeof(Vector3)), 0);
  EXPECT_EQ(std::memcmp(a.radius.data(), b.radius.data(), a.size() * sizeof(double)), 0);
}

std::string lammps_data(const std::string &atoms, const std::string &first = "an export") {
  return first +
         "\n\n 24 atoms\n1 atom types\n\n-0.002 0.002 xlo xhi\n-0.1 0.1 ylo yhi\n0.0 0.006 zlo "
         "zhi\n\nMasses\n\n"
         "1 1.0\n\nAtoms # sphere\n\n" +
         atoms + "\nVelocities\n\n1 0 0 0 0 0 0\n";
}
std::string lammps_frame(int step, const std::string &columns, const std::string &atoms, int count = 24) {
  return fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n-0.1 0.1\n-0.1 0.1\n"
      "0 0.2\nITEM: ATOMS {}\n{}",
      step, count, columns, atoms);
}
std::string dumped(int shift) {
  return rows([shift](int number, int x, int y, int z) {
    return fmt::format("{} 1 {} {} {} 0 0 0 {}", number + 1, in_m(x + shift), in_m(y), in_m(z), in_m(radius));
  });
}

TEST_F(SpecimenFormats, one_lattice_in_eight_forms_has_the_same_bits) {
  const SpecimenFile reference = lattice();
  EXPECT_EQ(reference.specimen.centre[0].x, -0.00131);
  EXPECT_EQ(reference.specimen.radius[0], 0.00065);
  EXPECT_TRUE(reference.notes.empty());
  SpecimenForm with_ids;
  with_ids.with_ids = true;
  const auto in_order_of_export = [](int number, int x, int y, int z) {
    return fmt::format("{},{},granite,{},{},{}", 7 * number, in_m(z), in_m(2 * radius), in_m(x), in_m(y));
  };
  const SpecimenFile numbered =
      read("id,Z_m,material,Diameter_m,x_m,y_m\n" + rows(in_order_of_export), with_ids);
  expect_same_bits(numbered.specimen, reference.specimen);
  ASSERT_EQ(numbered.ids.size(), 24u);
  EXPECT_EQ(numbered.ids[3], 21);
  const auto mixed = [](int, int x, int y, int z) {
    return fmt::format("{}\t{}\t{}\t{}", x == 0 ? "0" : decimal(x, 3), in_mm(y), 10 * z, in_m(radius));
  };
  expect_same_bits(read("\"x [cm]\"\ty_mm\tz (\xc2\xb5m)\tR (m)\n" + rows(mixed)).specimen,
                   reference.specimen);
  const auto german = [](int number, int x, int y, int z) {
    return fmt::format("{};{};{};{};{}", number, with_comma(in_mm(x)), with_comma(in_mm(y)),
                       with_comma(decimal(z, 3)) + "e+1", with_comma(in_mm(radius)));
  };
  const SpecimenFile commas = read("Nr;x [mm];y [mm];z [mm];radius [mm]\n" + rows(german));
  expect_same_bits(commas.specimen, reference.specimen);
  EXPECT_EQ(commas.notes, Words{"commas in numbers are decimal signs"});
  expect_same_bits(read("#format x_y_z_r\n# by hand\n" + plain("\t")).specimen, reference.specimen);
  SpecimenForm form;
  form.format = SpecimenFormat::yade;
  expect_same_bits(read(plain("  "), form).specimen, reference.specimen);
  const SpecimenFile dump = read(lammps_frame(0, "id type x y z vx vy vz radius", dumped(7)) +
                                     lammps_frame(100, "id type xu yu zu vx vy vz radius", dumped(0)),
                                 with_ids);
  expect_same_bits(dump.specimen, reference.specimen);
  EXPECT_EQ(dump.ids.size(), 24u);
  EXPECT_EQ(dump.notes, Words{"lengths without a unit: m"});
  for (const char *image : {"", " 0 0 0"}) {
    const auto atom = [image](int number, int x, int y, int z) {
      return fmt::format("{} 1 {} 2500 {} {} {}{}", number + 1, in_m(2 * radius), in_m(x), in_m(y), in_m(z),
                         image);
    };
    const SpecimenFile data = read(lammps_data(rows(atom), "LAMMPS data file, units = si"));
    expect_same_bits(data.specimen, reference.specimen);
    EXPECT_TRUE(data.notes.empty());
  }
  form = {SpecimenFormat::automatic, "nr, x_mm, y_mm, z_mm, diameter_mm"};
  for (const bool decimal_commas : {false, true}) {
    const auto bare = [decimal_commas](int number, int x, int y, int z) {
      const std::string row =
          fmt::format("{} {} {} {} {}", number, in_mm(x), in_mm(y), in_mm(z), in_mm(2 * radius));
      std::string other = row;
      std::replace(other.begin(), other.end(), '.', ',');
      return decimal_commas ? other : row;
    };
    expect_same_bits(read(rows(bare), form).specimen, reference.specimen);
  }
}

TEST_F(SpecimenFormats, a_plain_name_is_in_m_and_told) {
  const SpecimenFile plainly = read("x y z r\n" + plain(" "));
  expect_same_bits(plainly.specimen, lattice().specimen);
  EXPECT_EQ(plainly.notes, Words{"columns x, y, z, r without a unit: m"});
}

TEST_F(SpecimenFormats, what_is_written_for_others_is_read_back_to_the_same_bits) {
  dem::Specimen specimen = lattice().specimen;
  specimen.shape = dem::cylinder(0.1 / 3, 0.01);
  specimen.radius[5] = 0.1 / 149;
  const std::pair<SpecimenFormat, const char *> written[] = {{SpecimenFormat::yade, "specimen.yade.txt"},
                                                             {SpecimenFormat::lammps_data, "specimen.data"},
                                                             {SpecimenFormat::lammps_dump, "specimen.dump"}};
  for (const auto &[format, name] : written) {
    write_specimen_as(format, folder_, specimen, 2650);
    for (const SpecimenFormat as : {SpecimenFormat::automatic, format}) {
      SpecimenForm form;
      form.format = as, form.with_ids = format != SpecimenFormat::yade;
      const SpecimenFile back = read_specimen_file(folder_ / name, form);
      expect_same_bits(back.specimen, specimen);
      EXPECT_TRUE(back.notes.empty()) << name;
      EXPECT_EQ(back.ids.empty(), format == SpecimenFormat::yade) << name;
      EXPECT_EQ(back.states_shape, format != SpecimenFormat::lammps_dump) << name;
      if (back.states_shape) {
        EXPECT_EQ(back.specimen.shape.radius, specimen.shape.radius) << name;
      }
    }
  }
  EXPECT_TRUE(contains(content_of(folder_ / "specimen.data"), "\n1 1 0.0013 2650 -0.00131 0 0.00065\n"));
}

TEST_F(SpecimenFormats, the_shape_is_what_the_spheres_reach_and_they_are_moved_into_it) {
  const std::string far = "x_m,y_m,z_m,r_m\n3,5,7,1\n5,5,7,1\n3,7,7,1\n5,7,9,1\n";
  SpecimenForm form;
  form.filled = dem::ShapeKind::box;
  const SpecimenFile box = read(far, form);
  EXPECT_FALSE(box.states_shape);
  EXPECT_EQ(box.specimen.shape.kind, dem::ShapeKind::box);
  EXPECT_DOUBLE_EQ(box.specimen.shape.width_x, 4);
  EXPECT_DOUBLE_EQ(box.specimen.shape.width_y, 4);
  EXPECT_DOUBLE_EQ(box.specimen.shape.height, 4);
  EXPECT_DOUBLE_EQ(box.specimen.centre[0].x, -1);
  EXPECT_DOUBLE_EQ(box.specimen.centre[0].y, -1);
  EXPECT_DOUBLE_EQ(box.specimen.centre[0].z, 1);
  EXPECT_TRUE(dem::check_specimen(box.specimen).empty());
  ASSERT_EQ(box.notes.size(), 2u);
  EXPECT_TRUE(contains(box.notes[0], "a box of 4000 x 4000 x 4000 mm"));
  EXPECT_TRUE(contains(box.notes[1], "moved by -4000, -6000, -6000 mm"));
  form.filled = dem::ShapeKind::cylinder;
  const SpecimenFile round = read(far, form);
  EXPECT_EQ(round.specimen.shape.kind, dem::ShapeKind::cylinder);
  EXPECT_DOUBLE_EQ(round.specimen.shape.radius, std::sqrt(2.0) + 1);
  EXPECT_DOUBLE_EQ(round.specimen.shape.height, 4);
  EXPECT_TRUE(dem::check_specimen(round.specimen).empty());
  // What the file states holds.
  const SpecimenFile stated = read("# shape: box width_x_m=20 width_y_m=20 height_m=20\n" + far, form);
  EXPECT_EQ(stated.specimen.shape.width_x, 20);
  EXPECT_EQ(stated.specimen.centre[0].x, 3);
  EXPECT_TRUE(stated.notes.empty());
}

TEST_F(SpecimenFormats, wrong_files_are_refused_with_what_was_expected) {
  const std::string row = "1 1 0.2 2500 1 2 3\n";
  const auto one_atom = [&](const std::string &atom, const std::string &style = " # sphere") {
    return "title\n\n1 atoms\n\nAtoms" + style + "\n\n" + atom;
  };
  expect_refused("x_m,y_m,radius_m\n1,2,3\n", {":1: ", "names no column z", "z_m or z [mm]"});
  expect_refused("x_m,y_m,z_m\n1,2,3\n", {":1: ", "names no column radius or r or diameter"});
  expect_refused("x_ft,y_m,z_m,r_m\n1,2,3,4\n",
                 {":1: ", "\"x_ft\" has a unit that is not known", "m, cm, mm, um"});
  expect_refused("x [Zoll],y_m,z_m,r_m\n1,2,3,4\n", {":1: ", "\"x [Zoll]\" has a unit", "m, cm, mm, um"});
  expect_refused("x_m,X_mm,y_m,z_m,r_m\n1,1,2,3,4\n", {":1: ", "two columns", "\"x_m\" and \"X_mm\""});
  expect_refused("x_m,y_m,z_m,r_m,diameter_m\n1,1,2,3,4\n",
                 {":1: ", "two columns", "\"r_m\" and \"diameter_m\""});
  expect_refused("x_m;y_m;z_m;r_m\n1;2;3;4\n1;zwei;3;4\n",
                 {":3: ", "column y_m: \"zwei\" is not a finite number"});
  expect_refused("x_m;y_m;z_m;r_m\n1;2;1.234,5;4\n", {":2: ", "column z_m: \"1.234,5\""});
  expect_refused("x_m;y_m;z_m;r_m\n1;2;3\n", {":2: ", "a row has 3 values, the header names 4 columns"});
  expect_refused("x_m;y_m;z_m;r_m\n1;2;3;-4\n", {":2: ", "column r_m: -4 is not positive"});
  expect_refused("x_m;y_m;z_m;r_m\n# none\n", {"holds no sphere"});
  expect_refused("x_mm,y_mm,z_mm,r_mm\n1,5,2,5,3,5,0,5\n",
                 {":2: ", "8 values", "Decimal commas need columns that semicolons or tabs part"});
  expect_refused("0 0 1 1\n", {":1: ", "is not the header line", "Specimen/File columns"});
  expect_refused("x_m,y_m,z_m,r_m\n1,2,3,4\n", {":1: ", "is a header, and Specimen/File columns"},
                 {SpecimenFormat::automatic, "x_m, y_m, z_m, r_m"});
  expect_refused("1,2,3,4\n", {"Specimen/File columns names no column x"},
                 {SpecimenFormat::automatic, "id, y_m, z_m, r_m"});
  expect_refused("#format x_y_z_r\n1 2 3 4\n", {"is of format yade, which names its columns itself"},
                 {SpecimenFormat::automatic, "x, y, z, r"});
  expect_refused("#format x_y_z\n1 2 3\n", {":1: ", "#format names no column radius"});
  expect_refused("1 2 3\n", {":1: ", "a row has 3 values, Yade's x_y_z_r names 4"},
                 {SpecimenFormat::yade, ""});
  expect_refused(one_atom(row + row), {"lists 2 atoms, where 1 are told"});
  expect_refused(one_atom(row, " # bond"), {":5: ", "style \"bond\". Allowed: sphere"});
  expect_refused(one_atom("1 1 1 2 3\n", ""), {":7: ", "5 values, atom style sphere names 7"});
  expect_refused("title, units = real\n1 atoms\nAtoms\n\n" + row,
                 {":1: ", "units are \"real\". Allowed: si"});
  expect_refused("title\n1 atoms\n2 2 zlo zhi\nAtoms\n\n" + row,
                 {":3: ", "the box along z is flat, from 2 to 2"});
  expect_refused("title\n1 atoms\n", {"lists no atoms"});
  const std::string xs = lammps_frame(0, "id type xs ys zs radius", "1 1 0 0 0 1\n", 1);
  expect_refused(xs, {":9: ", "\"xs\" is a scaled coordinate", "Allowed: x, y, z"});
  expect_refused(lammps_frame(0, "x y z", "0 0 0\n", 1), {":9: ", "ITEM: ATOMS names no column radius"});
  const std::string one = "0 0 0 1\n", good = lammps_frame(0, "x y z radius", one, 1);
  expect_refused(lammps_frame(0, "x y z radius", one + one, 3), {"lists 2 atoms, where 3 are told"});
  expect_refused(lammps_frame(0, "x y z radius", one, 2) + good, {"lists 1 atoms, where 2 are told"});
  expect_refused(lammps_frame(0, "x y z radius", one, 1) + "ITEM: NUMBER OF ATOMS\nmany\n",
                 {"\"many\" is no number of atoms"});
}

} // namespace
} // namespace platen::apps::testing::formats
