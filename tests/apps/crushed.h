// Runs of platen-compress on the small scenes of tests/apps/scenes: crushed, watched, stopped and led on.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <map>
#include <string>
#include <vector>

#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {

using Words = std::vector<std::string>;

inline Words with(Words words, const Words &more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
// As options of a command line.
inline Words set(const Words &entries) {
  Words options;
  for (const std::string &entry : entries)
    options.insert(options.end(), {"-s", entry});
  return options;
}

// Concrete of elasto-damage-plastic interfaces.
inline Words concrete(const Words &more = {}) {
  return with({"Effects/Bond = elasto damage plastic", "Bond/Modulus = 28 GPa", "Bond/Poisson ratio = 0.2",
               "Bond/Tensile strength = 5 MPa", "Bond/Shear strength = 16 MPa", "Bond/Friction static = 0.9",
               "Bond/Friction dynamic = 0.25", "Bond/Compression limits = 20 MPa, 45 MPa, 70 MPa",
               "Bond/Compression slopes = 3, 12, 22", "Contact/Friction = 0.25"},
              more);
}

class Crushed : public ScratchFolder {
protected:
  enum class Frames { off, as_in_the_scene };
  explicit Crushed(const std::string &scene = "crushed.prm", Frames frames = Frames::off,
                   const std::string &program = "platen-compress")
      : scene_(test_scene(scene)),
        frames_(frames),
        program_(fs::path(compress_command({}).front()).replace_filename(program)) {}

  // Writes a scene: the crushed cylinder and `lines` after it, from line 2 on.
  void scene(const std::string &name, const std::string &lines) const {
    put(folder_ / name, "include " + scene_ + "\n" + lines);
  }
  // Of a run into the folder `name` with entries of its own.
  Words arguments(const std::string &name, const Words &entries, const Words &options = {}) const {
    Words all{scene_, "-o", name};
    if (frames_ == Frames::off) all.insert(all.end(), {"-s", "Output/Fields = off"});
    return with(with(all, set(entries)), options);
  }
  Words command(const std::string &name, const Words &entries, const Words &options = {}) const {
    return with({program_.string()}, arguments(name, entries, options));
  }
  // To its end, with this status; gives the summary. What it printed is kept.
  nlohmann::json crush(const std::string &name, const Words &entries, const Words &options = {},
                       int status = 0) {
    outcome_ = run_program(command(name, entries, options), folder_);
    EXPECT_EQ(outcome_.status, status) << name << ": " << outcome_.error;
    return summary_in(folder_ / name);
  }
  // The same, made once for all tests of this process, which leave it as it is; its folder.
  fs::path crushed_once(const Words &entries = {}) const {
    static std::map<Words, fs::path> made;
    const Words key = command("", entries);
    if (const auto found = made.find(key); found != made.end()) return found->second;
    const std::string name = std::to_string(made.size());
    const Outcome outcome = run_program(command(name, entries), process_folder());
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    return made[key] = process_folder() / name;
  }
  // Starts or goes on with a run, and sends `signal` once history.csv holds so many lines; its status.
  int stop_at(const std::string &name, long lines, int signal, const Words &entries,
              const Words &options = {}) const {
    Program program(command(name, entries, options), folder_);
    EXPECT_TRUE(program.wait_until([&] { return lines_in(folder_ / name / "history.csv") >= lines; }))
        << content_of(folder_ / "error.txt");
    program.send(signal);
    return program.wait();
  }
  std::vector<double> column(const std::string &name, const std::string &column) const {
    return column_of(folder_ / name / "history.csv", column);
  }
  std::string log(const std::string &name) const { return content_of(folder_ / name / "run.log"); }
  // All files and figures but what they cost. Folders are those of the test, or whole paths.
  void expect_same(const fs::path &one, const fs::path &other) const {
    EXPECT_EQ(difference(results_in(folder_ / one), results_in(folder_ / other)), "");
    EXPECT_EQ(figures(one), figures(other));
  }
  nlohmann::json figures(const fs::path &name) const {
    nlohmann::json summary = summary_in(folder_ / name);
    for (const char *cost : {"threads", "wall_seconds", "setup_seconds", "particle_steps_per_second",
                             "stage_seconds", "peak_memory_bytes", "bytes_in_columns_and_search"})
      summary.erase(cost);
    return summary;
  }
  static bool has(const nlohmann::json &words, const std::string &word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  }

  const std::string scene_;
  const Frames frames_;
  const fs::path program_;
  Outcome outcome_; // of the last run that was crushed
};

} // namespace platen::apps::testing
