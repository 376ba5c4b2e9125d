// Packings that runs share: the same bytes as without, made once, and never taken where they are damaged.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "apps/output/file_lock.h"
#include "apps/output/sha256.h"
#include "apps/run/packing_cache.h"
#include "apps/run/shared_packing.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

const Words short_test = set({"Specimen/Sphere radius = 2 mm", "Loading/Target strain = 0.005"});

class SharedPacking : public ScratchFolder {
protected:
  Words arguments(const std::string &name, const Words &options = {}) const {
    return with(with({test_scene("study.prm"), "-o", name, "-t", "1"}, short_test), options);
  }
  Outcome run(const std::string &name, const Words &options = {}) const {
    Outcome outcome = run_compress(arguments(name, options), folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    return outcome;
  }
  Outcome sharing(const std::string &name, Words options = {}) const {
    return run(name, with(std::move(options), {"--packings", "kept"}));
  }
  std::string difference_of(const std::string &a, const std::string &b) const {
    return difference(results_in(folder_ / a), results_in(folder_ / b));
  }
  std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(folder_ / "kept"))
      if (entry.path().extension() == ".csv") files.push_back(entry.path());
    return files;
  }
  // Other spheres under the recipe of the packing that is kept, as if they were its own.
  void plant(const std::string &spheres) const {
    const std::string text = content_of(kept().at(0)),
                      planted = text.substr(0, text.find('\n') + 1) + spheres;
    put(kept().at(0), planted + "# sha256 of all above: " + sha256_of(planted) + "\n");
  }
};

TEST_F(SharedPacking, changes_no_byte_of_what_a_run_leaves) {
  run("alone");
  sharing("first");
  sharing("second");
  EXPECT_EQ(difference_of("alone", "first"), "");
  EXPECT_EQ(difference_of("alone", "second"), "");
  EXPECT_EQ(kept().size(), 1u);
}

// Of another seed: what a run takes is what is there.
TEST_F(SharedPacking, is_taken_from_the_file) {
  sharing("mine");
  run("other", {"-s", "Scene/Seed = 8"});
  const std::string spheres = content_of(folder_ / "other/specimen.csv");
  plant(spheres);
  sharing("taken");
  EXPECT_EQ(content_of(folder_ / "taken/specimen.csv"), spheres);
  EXPECT_NE(content_of(folder_ / "mine/specimen.csv"), spheres);
}

TEST_F(SharedPacking, that_is_damaged_is_told_and_made_anew) {
  sharing("whole");
  const fs::path file = kept().at(0);
  const std::string text = content_of(file);
  std::string digit = text, recipe = text;
  char &last_of_z = digit[text.rfind('\n', text.size() - 100) - 1];
  last_of_z = last_of_z == '1' ? '2' : '1';
  recipe.replace(recipe.find("Scene/Seed = 3"), 14, "Scene/Seed = 4");
  const std::vector<std::pair<std::string, std::string>> faults{
      {digit, "is not as it was written"},
      {text.substr(0, text.size() / 2), "is not as it"},
      {text.substr(0, 20), "is cut short"},
      {"", "is cut short"},
      {recipe, "is of another recipe"}};
  int number = 0;
  for (const auto &[content, says] : faults) {
    put(file, content);
    const std::string name = "damaged_" + std::to_string(++number);
    const Outcome outcome = sharing(name);
    EXPECT_TRUE(contains(outcome.error, file.filename().string() + ": " + says)) << outcome.error;
    EXPECT_TRUE(contains(outcome.error, "the specimen is packed anew")) << outcome.error;
    EXPECT_EQ(difference_of("whole", name), "");
    EXPECT_EQ(content_of(file), text) << says;
  }
}

TEST_F(SharedPacking, of_another_recipe_is_another_file) {
  const std::vector<Words> others{{},
                                  {"-s", "Scene/Seed = 8"},
                                  {"-s", "Specimen/Height = 21 mm"},
                                  {"-s", "Specimen/Radius spread = 0.3"}};
  for (std::size_t k = 0; k < others.size(); ++k) {
    sharing("of_" + std::to_string(k), others[k]);
    EXPECT_EQ(kept().size(), k + 1);
  }
  // What is done to it afterwards does not count.
  sharing("bonds", {"-s", "Specimen/End layer = 0.5", "-s", "Bond/Gap = 0.1 R_min", "-s",
                    "Platens/Friction static = 0.2"});
  EXPECT_EQ(kept().size(), others.size());
}

TEST_F(SharedPacking, that_cannot_be_kept_does_no_harm) {
  run("alone");
  put(folder_ / "kept", "a file where the folder would be");
  const Outcome outcome = sharing("a");
  EXPECT_TRUE(contains(outcome.error, "the packing is not shared")) << outcome.error;
  EXPECT_EQ(difference_of("alone", "a"), "");
}

TEST_F(SharedPacking, is_made_once_by_runs_that_want_it_at_once_and_tidied) {
  sharing("whole");
  const fs::path file = kept().at(0);
  fs::remove(file);
  const fs::path part =
      folder_ / "kept" / (file.stem().string() + ".node7_4242.part.csv"); // of one that was killed
  put(part, "half");
  // Another process holds the lock until the run says that it waits.
  int ready[2];
  ASSERT_EQ(pipe2(ready, O_CLOEXEC), 0);
  const std::uint64_t byte = std::stoull(file.stem().string().substr(0, 8), nullptr, 16);
  const pid_t holder = fork();
  if (holder == 0) {
    const auto lock = FileLock::take(folder_ / "kept/in_use", {byte, 1}, std::chrono::milliseconds(0), [] {});
    if (lock != nullptr && lock->holds() && write(ready[1], "1", 1) == 1) pause();
    _exit(1);
  }
  char one = 0;
  ASSERT_EQ(read(ready[0], &one, 1), 1);
  Program waiting(compress_command(arguments("waiting", {"--packings", "kept", "--verbose"})), folder_);
  ASSERT_TRUE(waiting.wait_until([&] {
    return fs::exists(folder_ / "out.txt") &&
           contains(content_of(folder_ / "out.txt"),
                    "waits for the run that packs kept/" + file.filename().string());
  }));
  EXPECT_FALSE(fs::exists(file));
  EXPECT_TRUE(fs::exists(part));
  kill(holder, SIGKILL);
  waitpid(holder, nullptr, 0);
  EXPECT_EQ(waiting.wait(), 0);
  EXPECT_EQ(difference_of("whole", "waiting"), "");
  EXPECT_TRUE(fs::exists(file));
  EXPECT_FALSE(fs::exists(part));
}

TEST_F(SharedPacking, is_not_written_by_a_dry_run) {
  Outcome outcome = run_compress(arguments("dry", {"--packings", "kept", "--dry-run"}), folder_);
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_FALSE(fs::exists(folder_ / "kept"));
}

// A cache for as long as it stands.
class Cache {
public:
  explicit Cache(const fs::path &folder) { setenv("PLATEN_CACHE", folder.c_str(), 1); }
  ~Cache() { setenv("PLATEN_CACHE", "none", 1); }
  Cache(const Cache &) = delete;
  Cache &operator=(const Cache &) = delete;
};

TEST_F(SharedPacking, is_found_in_the_cache_by_later_runs_that_do_not_forbid_it) {
  const Cache cache(folder_ / "kept");
  run("first");
  ASSERT_EQ(kept().size(), 1u);
  run("other", {"-s", "Scene/Seed = 8", "--no-cache"});
  ASSERT_EQ(kept().size(), 1u) << "--no-cache keeps nothing";
  const std::string spheres = content_of(folder_ / "other/specimen.csv");
  plant(spheres);
  run("taken", {"-s", "Bond/Modulus = 30 GPa"});
  EXPECT_EQ(content_of(folder_ / "taken/specimen.csv"), spheres);
  for (const Words &options : {Words{"--no-cache"}, {"-s", "Specimen/Cache = none"}}) {
    run("packed", with(options, {"--overwrite"}));
    EXPECT_EQ(content_of(folder_ / "packed/specimen.csv"), content_of(folder_ / "first/specimen.csv"));
  }
  run("own", {"-s", "Specimen/Cache = " + (folder_ / "mine").string()});
  EXPECT_TRUE(fs::exists(folder_ / "mine" / kept().at(0).filename()));
}

TEST_F(SharedPacking, that_no_cache_can_keep_is_packed_without_a_word) {
  put(folder_ / "file", "");
  const Cache cache(folder_ / "file");
  EXPECT_FALSE(contains(run("alone").error, "packing"));
}

TEST_F(SharedPacking, those_not_used_for_longest_are_removed_from_a_full_cache) {
  const auto now = fs::file_time_type::clock::now();
  for (int k = 1; k <= 4; ++k) {
    const fs::path file = folder_ / (std::to_string(k) + ".csv");
    put(file, std::string(100, 'x'));
    fs::last_write_time(file, now - std::chrono::hours(k));
  }
  put(folder_ / "in_use", std::string(1000, 'x'));
  trim_packings(folder_, 250, folder_ / "4.csv");
  for (const auto &[name, stays] : std::map<std::string, bool>{
           {"1.csv", true}, {"2.csv", true}, {"3.csv", false}, {"4.csv", true}, {"in_use", true}})
    EXPECT_EQ(fs::exists(folder_ / name), stays) << name;
}

TEST_F(Study, runs_on_one_seed_share_their_packing_and_change_no_byte) {
  const Words rates{"--quiet", "-s", "Study/Axial rate list = 1 m/s, 2 m/s, 4 m/s"};
  ASSERT_EQ(run("a", rates, "rate").status, 0);
  int files = 0;
  for (const auto &entry : fs::directory_iterator(folder_ / "a/packings"))
    files += entry.path().extension() == ".csv";
  EXPECT_EQ(files, 2); // seeds
  for (const char *rate : {"1", "2", "4"}) {
    const std::string name = std::string("rate_") + rate + "_seed_4";
    const Outcome alone =
        run_compress({(folder_ / "a/runs" / name / "scene.prm").string(), "-o", name, "-t", "1"}, folder_);
    ASSERT_EQ(alone.status, 0) << alone.error;
    EXPECT_EQ(difference(results_in(folder_ / name), results_in(folder_ / "a/runs" / name)), "");
  }
  const std::string before = table("a");
  fs::remove_all(folder_ / "a/runs/rate_4_seed_4");
  put((*fs::directory_iterator(folder_ / "a/packings")).path(), "damaged");
  EXPECT_EQ(run("a", with(rates, {"--resume"}), "rate").status, 0);
  EXPECT_EQ(table("a"), before);
  // A study begun anew takes nothing from the one before.
  put(folder_ / "a/packings/mine.txt", "kept");
  ASSERT_EQ(run("a", {"--quiet", "--overwrite"}).status, 0); // sizes: each run has its own
  EXPECT_TRUE(fs::exists(folder_ / "a/packings/mine.txt"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "a/packings"), {}), 1);
}

} // namespace
} // namespace platen::apps::testing
