// platen-study as a user runs it, on specimens of a hundred spheres; and what it plans.
#pragma once

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "apps/program.h"
#include "apps/programs.h"
#include "apps/scratch_folder.h"
#include "apps/study/cases.h"

namespace platen::apps::testing {

using Words = std::vector<std::string>;

// The texts of one column.
inline Words words_in(const fs::path &csv, const std::string &name) {
  std::istringstream rows(content_of(csv));
  Words words;
  std::size_t column = 0;
  for (std::string row; std::getline(rows, row);) {
    std::istringstream cells(row);
    Words parts;
    for (std::string part; std::getline(cells, part, ',');)
      parts.push_back(part);
    if (words.empty())
      column = static_cast<std::size_t>(std::find(parts.begin(), parts.end(), name) - parts.begin());
    words.push_back(column < parts.size() ? parts[column] : "");
  }
  if (!words.empty()) words.erase(words.begin());
  return words;
}

inline Words with(Words options, const Words &more) {
  options.insert(options.end(), more.begin(), more.end());
  return options;
}
// As options that set them.
inline Words set(const Words &entries) {
  Words options;
  for (const std::string &entry : entries)
    options.insert(options.end(), {"-s", entry});
  return options;
}

// study.prm has a list of sphere radii.
constexpr const char *no_radii = "Study/Sphere radius list =";

inline Scene study_scene(const Words &entries) {
  return read_scene(test_scene("study.prm"), entries, program("study"));
}
inline StudyPlan plan_of(StudyKind kind, const Words &entries) {
  return plan_study(kind, study_scene(entries), entries);
}
// What a case of study.prm leads to.
inline Scene led_to(const StudyCase &of, unsigned long seed, const Words &entries) {
  return read_scene(of.scene.empty() ? test_scene("study.prm") : of.scene, overrides_of(of, seed, entries),
                    program("compress"));
}
inline Words names_of(const StudyPlan &plan) {
  Words names;
  for (const StudyCase &one : plan.cases)
    names.push_back(one.name);
  return names;
}

// The run that is under way, by its parent in /proc.
inline pid_t child_of(pid_t parent) {
  std::ifstream children("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  pid_t child = -1;
  children >> child;
  return children ? child : -1;
}

class Study : public ScratchFolder {
protected:
  // One run at a time where `options` do not say otherwise.
  Words command(const std::string &name, const Words &options, const std::string &kind = "size") const {
    Words all{PLATEN_STUDY_PROGRAM, kind, test_scene("study.prm"), "-o", name};
    if (std::find(options.begin(), options.end(), "-t") == options.end()) all.insert(all.end(), {"-t", "1"});
    return with(all, options);
  }
  Outcome run(const std::string &name, const Words &options, const std::string &kind = "size") const {
    Outcome outcome;
    outcome.status = Program(command(name, options, kind), folder_).wait();
    outcome.out = content_of(folder_ / "out.txt");
    outcome.error = content_of(folder_ / "error.txt");
    return outcome;
  }
  // The whole study with these options as the folder `name`, made once for all tests of this process.
  void make_once(const std::string &name, const Words &options, const std::string &kind = "size") const {
    static std::map<Words, fs::path> made;
    fs::path &one = made[with({kind}, options)];
    if (one.empty()) {
      one = process_folder() / ("study_" + std::to_string(made.size()));
      ASSERT_EQ(run(one.string(), options, kind).status, 0) << content_of(folder_ / "error.txt");
    }
    fs::copy(one, folder_ / name, fs::copy_options::recursive);
  }
  // A run that ends with this status and these words on standard error.
  void expect(int status, const std::string &says, const std::string &name, const Words &options,
              const std::string &kind = "size") const {
    const Outcome outcome = run(name, options, kind);
    EXPECT_EQ(outcome.status, status) << ::testing::PrintToString(options) << outcome.error;
    EXPECT_TRUE(contains(outcome.error, says)) << "expected " << says << "\ncame " << outcome.error;
  }
  std::string table(const std::string &name) const { return content_of(folder_ / name / "study.csv"); }
  nlohmann::json json(const std::string &name) const {
    return nlohmann::json::parse(content_of(folder_ / name / "study.json"));
  }
  void expect_same_tables(const std::string &a, const std::string &b) const {
    EXPECT_EQ(table(a), table(b));
    EXPECT_EQ(content_of(folder_ / a / "study.json"), content_of(folder_ / b / "study.json"));
  }
  // Killed again and again, at once taken up: the runs that were under way end on their own, and the next
  // study waits for them.
  void expect_the_same_however_often_killed(const Words &options, const std::string &kind) const {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(run("whole", options, kind).status, 0);
    const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> wait(0.01 * whole, 0.3 * whole); // s
    const auto begun = [&] { return fs::exists(folder_ / "killed/study.json"); };
    int kills = 0, status = -1;
    for (int round = 0; round < 10 && status != 0; ++round) {
      const Words more{"-t", "2", begun() ? "--resume" : "--overwrite"};
      Program program(command("killed", with(options, more), kind), folder_);
      // The first two are killed at any time, the others once there is something to take up: a busy machine
      // may need longer to start than the longest wait.
      while (round >= 2 && !begun() && program.running())
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::this_thread::sleep_for(std::chrono::duration<double>(wait(engine)));
      if (program.running()) program.send(SIGKILL), ++kills;
      status = program.wait();
      ASSERT_TRUE(status == 0 || status == -SIGKILL) << content_of(folder_ / "error.txt");
    }
    EXPECT_GE(kills, 2);
    ASSERT_TRUE(begun());
    expect(0, "", "killed", with(options, {"--resume"}), kind);
    expect_same_tables("killed", "whole");
  }
};

// A study of four runs of which the third, fine enough, is met at work.
inline const Words slow = set({"Study/Sphere radius list = 2 mm, 0.9 mm"});
inline const char *const met_at_work = "sphere_radius_0.9_mm_seed_3";

} // namespace platen::apps::testing
