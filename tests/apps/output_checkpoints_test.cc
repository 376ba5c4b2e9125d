// Checkpoints: the file, and the two newest of a folder.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>

#include "apps/output/checkpoint.h"
#include "apps/output/checkpoint_folder.h"
#include "apps/scratch_folder.h"
#include "base/vector3.h"
#include "tests/same_state.h"

namespace platen::apps {
namespace {

using namespace testing;

struct Spheres {
  Table table;
  Column<Vector3> &position = table.add<Vector3>("position", "m");
  Column<double> &radius = table.add<double>("radius", "m");
  Column<int> &id = table.add<int>("id", "1");
  void describe(Archive &archive) { archive.table("rows", table); }
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

// One of every kind of value.
struct Part {
  double time = 0.1 + 0.2;
  std::uint64_t step = 123456789012;
  int gain = -3;
  bool on = true;
  Vector3 axis{1, -0.0, std::numeric_limits<double>::denorm_min()};
  std::vector<double> displacement{1.0 / 3, std::nan(""), -INFINITY};
  std::vector<float> empty;
  std::string scene = "set Title = \xc3\xa4\nsecond line";
  Spheres spheres;
  void describe(Archive &archive) {
    archive.version(1);
    archive("time", time, "s");
    archive("step", step);
    archive("gain", gain);
    archive("on", on);
    archive("axis", axis, "m");
    archive.rows("displacement", displacement, "m", any_value());
    archive.rows("empty", empty);
    archive.text("scene", scene);
    archive.part("spheres", spheres);
  }
};

class Checkpoint : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "state.platen";
  Part part_;
  void write(std::size_t particles) {
    fill(part_.spheres, particles);
    CheckpointWriter writer(path_);
    save_part(writer, "part", part_);
    writer.finish();
  }
  void read(Part &into) const {
    const CheckpointReader reader(path_);
    read_parts(reader, [&](Archive &archive) { archive.part("part", into); });
  }
};

TEST_F(Checkpoint, gives_back_every_bit) {
  write(100000); // columns larger than the writer's buffer, and others that go through it
  Part back;
  back.time = 0, back.step = 0, back.gain = 0, back.on = false, back.axis = {}, back.scene = "other";
  back.displacement = {5}, back.empty = {1, 2};
  fill(back.spheres, 3); // another length than the stored one
  read(back);
  EXPECT_TRUE(same_state(part_, back));
  EXPECT_EQ(back.spheres.table.size(), 100000u);
}

TEST_F(Checkpoint, of_equal_states_are_equal_files) {
  write(1000);
  const std::string first = content_of(path_);
  write(1000);
  EXPECT_EQ(first, content_of(path_));
}

TEST_F(Checkpoint, of_an_empty_table_is_an_empty_table) {
  write(0);
  Part back;
  back.spheres.table.resize(4);
  read(back);
  EXPECT_EQ(back.spheres.table.size(), 0u);
}

TEST_F(Checkpoint, tells_what_its_blocks_are) {
  write(4);
  const CheckpointReader reader(path_);
  const StoredBlock axis = *reader.find("part/axis"), position = *reader.find("part/spheres/rows/position");
  EXPECT_EQ(describe(axis.type), "8-byte floating-point numbers (m), 3 in a row");
  EXPECT_EQ(axis.rows, 1u);
  EXPECT_EQ(position.rows, 4u);
  EXPECT_EQ(describe(reader.find("part/step")->type), "8-byte unsigned integers");
  EXPECT_EQ(range_of(reader, "part/gain").least, -3);
  EXPECT_FALSE(reader.find("part/day"));
}

TEST_F(Checkpoint, holds_no_name_twice) {
  CheckpointWriter writer(path_);
  add_rows(writer, "time", std::vector<double>{1.0});
  EXPECT_THROW(add_rows(writer, "time", std::vector<double>{2.0}), std::logic_error);
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
  EXPECT_TRUE(
      contains(message_of<CheckpointError>([&] { CheckpointReader{path_}; }), "block \"part/scene\""));
}

TEST_F(Checkpoint, of_another_version_or_program_is_refused_with_the_reason) {
  write(1);
  const std::string whole = content_of(path_);
  std::string other = whole;
  other[8] = 99; // the version follows eight bytes of magic
  put(path_, other);
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{path_}; }), "version 99"));
  other[8] = 2; // the layout before this one
  put(path_, other);
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{path_}; }),
                       "has format version 2, this program reads version 3: its state has no names"));
  put(path_, std::string(5000, 'x'));
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{path_}; }), "not a checkpoint"));
  EXPECT_TRUE(contains(message_of<CheckpointError>([&] { CheckpointReader{folder_}; }), "no such"));
}

TEST_F(Checkpoint, without_its_end_is_refused) {
  fill(part_.spheres, 5);
  {
    CheckpointWriter writer(path_);
    save_part(writer, "spheres", part_.spheres);
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
  EXPECT_THROW(rows_of<double>(reader, "part/time", "s"), CheckpointError);
}

TEST_F(Checkpoint, on_a_full_disk_says_so) {
  fill(part_.spheres, 1000);
  const std::string text = message_of<OutputError>([&] {
    CheckpointWriter writer("/dev/full");
    save_part(writer, "part", part_);
    writer.finish();
  });
  EXPECT_TRUE(contains(text, "/dev/full") && contains(text, "No space left")) << text;
}

class CheckpointFolder : public ScratchFolder {
protected:
  fs::path checkpoints_ = folder_ / "checkpoint";
  fs::path write(std::uint64_t step) const {
    return write_checkpoint(checkpoints_, step, [&](StateSink &writer) {
      add_rows(writer, "step", std::vector<std::uint64_t>{step});
      add_rows(writer, "field", std::vector<double>(20000, static_cast<double>(step)));
    });
  }
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto &file : fs::directory_iterator(checkpoints_))
      names.insert(file.path().filename().string());
    return names;
  }
  static void damage(const fs::path &path) { fs::resize_file(path, fs::file_size(path) / 2); }
};

TEST_F(CheckpointFolder, keeps_the_two_newest) {
  for (const std::uint64_t step : {10, 20, 30, 40})
    write(step);
  EXPECT_EQ(names(), (std::set<std::string>{"step_000000000030.platen", "step_000000000040.platen"}));
  const FoundCheckpoint found = newest_whole_checkpoint(checkpoints_);
  EXPECT_EQ(found.step, 40u);
  EXPECT_TRUE(found.remarks.empty());
  EXPECT_EQ(rows_of<std::uint64_t>(CheckpointReader(found.path), "step").front(), 40u);
}

TEST_F(CheckpointFolder, falls_back_on_the_older_one_and_says_so) {
  write(10);
  const fs::path newest = write(20);
  damage(newest);
  const FoundCheckpoint found = newest_whole_checkpoint(checkpoints_);
  EXPECT_EQ(found.step, 10u);
  ASSERT_EQ(found.remarks.size(), 1u);
  EXPECT_TRUE(contains(found.remarks[0], newest.string()));
}

TEST_F(CheckpointFolder, drops_a_damaged_later_one_when_the_run_has_gone_on) {
  write(10);
  damage(write(20));
  write(15); // the run went on from step 10
  EXPECT_EQ(names(), (std::set<std::string>{"step_000000000010.platen", "step_000000000015.platen"}));
  EXPECT_EQ(newest_whole_checkpoint(checkpoints_).step, 15u);
}

TEST_F(CheckpointFolder, names_all_that_is_wrong_where_none_is_whole) {
  EXPECT_TRUE(
      contains(message_of<CheckpointError>([&] { newest_whole_checkpoint(checkpoints_); }), "no checkpoint"));
  const fs::path first = write(10), second = write(20);
  damage(first);
  damage(second);
  const std::string text = message_of<CheckpointError>([&] { newest_whole_checkpoint(checkpoints_); });
  EXPECT_TRUE(contains(text, first.string()) && contains(text, second.string())) << text;
}

TEST_F(CheckpointFolder, drops_what_a_killed_run_left_half_written) {
  put(checkpoints_ / "step_000000000099.part.platen", "half");
  write(10);
  EXPECT_EQ(names(), std::set<std::string>{"step_000000000010.platen"});
}

TEST_F(CheckpointFolder, leaves_files_of_the_user_alone) {
  put(checkpoints_ / "notes.txt", "mine");
  put(checkpoints_ / "step_1.platen.bak", "mine");
  for (const std::uint64_t step : {10, 20, 30})
    write(step);
  EXPECT_EQ(content_of(checkpoints_ / "notes.txt"), "mine");
  EXPECT_EQ(content_of(checkpoints_ / "step_1.platen.bak"), "mine");
}

TEST_F(CheckpointFolder, on_a_full_disk_keeps_the_former_ones) {
  write(10);
  write(20);
  // The next one is written through a name that leads to a device without room.
  const fs::path next = checkpoints_ / "step_000000000030.platen";
  fs::create_symlink("/dev/full", part_path(next));
  EXPECT_TRUE(contains(message_of<OutputError>([&] { write(30); }), "No space left"));
  EXPECT_EQ(names(), (std::set<std::string>{"step_000000000010.platen", "step_000000000020.platen"}));
  EXPECT_EQ(newest_whole_checkpoint(checkpoints_).step, 20u);
}

TEST_F(CheckpointFolder, always_holds_a_whole_one_however_the_run_is_killed) {
  using clock = std::chrono::steady_clock;
  const auto start = clock::now();
  for (std::uint64_t k = 1; k <= 5; ++k)
    write(k);
  double write_seconds = std::chrono::duration<double>(clock::now() - start).count() / 5;
  std::uint64_t step = 5;
  for (int kill_number = 0; kill_number < 200; ++kill_number) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (std::uint64_t k = step + 1;; ++k)
        write(k);
    }
    // From the start to the fourth write: every phase of one, longer where a busy machine wrote nothing.
    usleep(static_cast<useconds_t>(4e6 * write_seconds * (kill_number % 50) / 50));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const FoundCheckpoint found = newest_whole_checkpoint(checkpoints_);
    ASSERT_GE(found.step, step);
    if (found.step == step) write_seconds *= 1.02;
    EXPECT_TRUE(found.remarks.empty()) << found.remarks[0]; // none is half written under its name
    step = found.step;
    const std::vector<double> field = rows_of<double>(CheckpointReader(found.path), "field");
    EXPECT_EQ(field, std::vector<double>(20000, static_cast<double>(step)));
  }
  EXPECT_GT(step, 20u) << "the runs were killed before they wrote anything";
  write(step + 1);
  EXPECT_EQ(names().size(), 2u); // what the killed ones left half written is gone
}

} // namespace
} // namespace platen::apps
