#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "apps/io/checkpoint.h"
#include "dem/vector3.h"
#include "io_folder.h"

namespace platen::apps {
namespace {

using namespace testing;
using dem::Vector3;

struct Spheres {
  dem::Table table;
  dem::Column<Vector3> &position = table.add<Vector3>("position", "m");
  dem::Column<double> &radius = table.add<double>("radius", "m");
  dem::Column<int> &id = table.add<int>("id", "1");
};

void fill(Spheres &spheres, std::size_t n) {
  spheres.table.resize(n);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t k = 0; k < n; ++k) {
    spheres.position[k] = {uniform(random), uniform(random), uniform(random)};
    spheres.radius[k] = 1 + uniform(random);
    spheres.id[k] = static_cast<int>(n - k);
  }
}

void write_all(CheckpointWriter &writer, const Spheres &spheres) {
  writer.add("clock/time", 0.1 + 0.2);
  writer.add("clock/step", std::uint64_t{123456789012});
  writer.add("servo/gain", -3);
  writer.add("servo/axis", Vector3{1, -0.0, std::numeric_limits<double>::denorm_min()});
  writer.add("body/displacement", std::vector<double>{1.0 / 3, std::nan(""), -INFINITY});
  writer.add("body/empty", std::vector<float>{});
  writer.add_text("scene", "set Title = \xc3\xa4\nsecond line");
  writer.add_table("particles", spheres.table);
  writer.finish();
}

class Checkpoint : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "state.platen";
  Spheres spheres_;
  void write(std::size_t particles) {
    fill(spheres_, particles);
    CheckpointWriter writer(path_);
    write_all(writer, spheres_);
  }
};

template <class T>
bool same_bits(const T &a, const T &b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

TEST_F(Checkpoint, gives_back_every_bit) {
  write(100000); // columns larger than the writer's buffer, and others that go through it
  CheckpointReader reader(path_);
  EXPECT_TRUE(same_bits(reader.value<double>("clock/time"), 0.1 + 0.2));
  EXPECT_EQ(reader.value<std::uint64_t>("clock/step"), 123456789012u);
  EXPECT_EQ(reader.value<int>("servo/gain"), -3);
  EXPECT_TRUE(same_bits(reader.value<Vector3>("servo/axis"),
                        Vector3{1, -0.0, std::numeric_limits<double>::denorm_min()}));
  std::vector<double> displacement;
  reader.get("body/displacement", displacement);
  ASSERT_EQ(displacement.size(), 3u);
  EXPECT_TRUE(same_bits(displacement[0], 1.0 / 3) && same_bits(displacement[1], std::nan("")) &&
              same_bits(displacement[2], -double(INFINITY)));
  std::vector<float> empty(5);
  reader.get("body/empty", empty);
  EXPECT_TRUE(empty.empty());
  EXPECT_EQ(reader.text("scene"), "set Title = \xc3\xa4\nsecond line");

  Spheres back;
  back.table.resize(3); // another length than the stored one
  reader.read_table("particles", back.table);
  ASSERT_EQ(back.table.size(), spheres_.table.size());
  for (std::size_t c = 0; c < back.table.columns().size(); ++c) {
    const auto &column = *back.table.columns()[c];
    EXPECT_EQ(std::memcmp(column.bytes(), spheres_.table.columns()[c]->bytes(),
                          column.size() * column.bytes_per_row()),
              0)
        << column.name();
  }
}

TEST_F(Checkpoint, of_equal_states_are_equal_files) {
  write(1000);
  const std::string first = content_of(path_);
  write(1000);
  EXPECT_EQ(first, content_of(path_));
}

TEST_F(Checkpoint, matches_columns_by_name_whatever_their_order) {
  write(10);
  dem::Table other;
  other.add<int>("id", "1");
  auto &radius = other.add<double>("radius", "m");
  other.add<Vector3>("position", "m");
  CheckpointReader(path_).read_table("particles", other);
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_EQ(radius[k], spheres_.radius[k]);
}

TEST_F(Checkpoint, of_an_empty_table_is_an_empty_table) {
  write(0);
  Spheres back;
  back.table.resize(4);
  CheckpointReader(path_).read_table("particles", back.table);
  EXPECT_EQ(back.table.size(), 0u);
}

TEST_F(Checkpoint, refuses_a_table_of_other_columns_by_name_and_leaves_it_alone) {
  write(10);
  const CheckpointReader reader(path_);
  const auto refused = [&](dem::Table &table) {
    table.resize(2);
    const std::string text = message_of<CheckpointError>([&] { reader.read_table("particles", table); });
    EXPECT_EQ(table.size(), 2u);
    return text;
  };
  Spheres more;
  more.table.add<double>("damage", "1");
  EXPECT_TRUE(contains(refused(more.table), "no column damage"));
  dem::Table fewer;
  fewer.add<Vector3>("position", "m");
  fewer.add<double>("radius", "m");
  EXPECT_TRUE(contains(refused(fewer), "column id"));
  dem::Table other_unit;
  other_unit.add<Vector3>("position", "mm");
  other_unit.add<double>("radius", "m");
  other_unit.add<int>("id", "1");
  EXPECT_TRUE(contains(refused(other_unit), "position (mm)"));
  dem::Table other_size;
  other_size.add<Vector3>("position", "m");
  other_size.add<float>("radius", "m");
  other_size.add<int>("id", "1");
  EXPECT_TRUE(contains(refused(other_size), "particles/radius"));
}

TEST_F(Checkpoint, gives_a_block_only_as_what_it_was_written) {
  write(1);
  const CheckpointReader reader(path_);
  const auto message = [](const auto &act) { return message_of<CheckpointError>(act); };
  EXPECT_TRUE(contains(message([&] { reader.value<std::uint64_t>("clock/time"); }), "clock/time"));
  EXPECT_TRUE(contains(message([&] { reader.value<float>("clock/time"); }), "8-byte floating"));
  EXPECT_TRUE(contains(message([&] { reader.value<double>("body/displacement"); }), "24 bytes"));
  EXPECT_TRUE(contains(message([&] { reader.text("clock/time"); }), "text"));
  EXPECT_TRUE(contains(message([&] { reader.value<int>("clock/day"); }), "no block \"clock/day\""));
}

TEST_F(Checkpoint, holds_no_name_twice) {
  CheckpointWriter writer(path_);
  writer.add("time", 1.0);
  EXPECT_THROW(writer.add("time", 2.0), std::logic_error);
}

TEST_F(Checkpoint, cut_off_anywhere_is_refused) {
  write(5);
  const std::string whole = content_of(path_);
  for (std::size_t length = whole.size(); length-- > 0;) {
    fs::resize_file(path_, length);
    EXPECT_THROW(CheckpointReader{path_}, CheckpointError) << length << " bytes";
  }
  put(path_, whole + '\0');
  EXPECT_THROW(CheckpointReader{path_}, CheckpointError);
  put(path_, whole);
  EXPECT_NO_THROW(CheckpointReader{path_});
}

TEST_F(Checkpoint, with_any_single_bit_flipped_is_refused) {
  write(5);
  const std::string bytes = content_of(path_);
  ASSERT_GT(8 * bytes.size(), 5000u);
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  const auto set = [&](std::size_t k, int byte) {
    file.seekp(static_cast<std::streamoff>(k));
    file.put(static_cast<char>(byte));
    file.flush();
  };
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    for (int bit = 0; bit < 8; ++bit) {
      set(k, bytes[k] ^ (1 << bit));
      EXPECT_THROW(CheckpointReader{path_}, CheckpointError) << "byte " << k << " bit " << bit;
    }
    set(k, bytes[k]);
  }
  EXPECT_NO_THROW(CheckpointReader{path_});
}

TEST_F(Checkpoint, names_the_block_that_is_damaged) {
  write(5);
  std::string bytes = content_of(path_);
  const std::size_t place = bytes.find("second line");
  ASSERT_NE(place, std::string::npos);
  bytes[place] = 'S';
  put(path_, bytes);
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{path_}; }), "block \"scene\""));
}

TEST_F(Checkpoint, of_another_version_or_program_is_refused_with_the_reason) {
  write(1);
  const std::string whole = content_of(path_);
  std::string other = whole;
  other[8] = 99; // the version follows eight bytes of magic
  put(path_, other);
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{path_}; }), "version 99"));
  put(path_, std::string(5000, 'x'));
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{path_}; }), "not a checkpoint"));
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{folder_}; }), "no such"));
}

TEST_F(Checkpoint, without_its_end_is_refused) {
  fill(spheres_, 5);
  {
    CheckpointWriter writer(path_);
    writer.add_table("particles", spheres_.table);
  }
  EXPECT_THROW(CheckpointReader{path_}, CheckpointError);
}

TEST_F(Checkpoint, changed_after_it_was_verified_gives_no_wrong_values) {
  write(5);
  const CheckpointReader reader(path_);
  std::string bytes = content_of(path_);
  const double time = 0.1 + 0.2;
  const std::size_t place = bytes.find(std::string(reinterpret_cast<const char *>(&time), sizeof time));
  ASSERT_NE(place, std::string::npos);
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(place));
  file.put('!');
  file.close();
  EXPECT_THROW(reader.value<double>("clock/time"), CheckpointError);
}

TEST_F(Checkpoint, on_a_full_disk_says_so) {
  fill(spheres_, 1000);
  const std::string text = message_of<OutputError>([&] {
    CheckpointWriter writer("/dev/full");
    write_all(writer, spheres_);
  });
  EXPECT_TRUE(contains(text, "/dev/full") && contains(text, "No space left")) << text;
}

} // namespace
} // namespace platen::apps
