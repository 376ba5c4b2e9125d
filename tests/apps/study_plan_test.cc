// A study made run by run: by whom, in what order and however often it is stopped, it leaves the bytes of one
// process.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include "apps/output/summary.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

// Four runs, two on each packing.
const std::vector<std::string> rates{"-s", "Study/Axial rate list = 2 m/s, 4 m/s"};

class PlannedStudy : public Study {
protected:
  Outcome asked(const std::string &name, const std::vector<std::string> &what,
                const std::string &kind = "rate", const std::vector<std::string> &options = rates) const {
    std::vector<std::string> all = options;
    all.insert(all.end(), what.begin(), what.end());
    return run(name, all, kind);
  }
  void expect(int status, const std::string &name, const std::vector<std::string> &what,
              const std::string &kind = "rate", const std::vector<std::string> &options = rates) const {
    const Outcome outcome = asked(name, what, kind, options);
    EXPECT_EQ(outcome.status, status) << ::testing::PrintToString(what) << outcome.error;
  }
  void expect_refused(const std::string &says, const std::string &name, const std::vector<std::string> &what,
                      const std::string &kind = "rate",
                      const std::vector<std::string> &options = rates) const {
    const Outcome outcome = asked(name, what, kind, options);
    EXPECT_EQ(outcome.status, 2) << outcome.error;
    EXPECT_TRUE(contains(outcome.error, says)) << "expected " << says << "\ncame " << outcome.error;
  }
  void expect_same(const std::string &a, const std::string &b) const {
    EXPECT_EQ(table(a), table(b));
    EXPECT_EQ(content_of(folder_ / a / "study.json"), content_of(folder_ / b / "study.json"));
    for (const auto &entry : fs::directory_iterator(folder_ / a / "runs"))
      EXPECT_EQ(
          difference(results_in(entry.path()), results_in(folder_ / b / "runs" / entry.path().filename())),
          "")
          << entry.path();
  }
};

TEST_F(PlannedStudy, made_in_any_order_leaves_the_bytes_of_one_process) {
  ASSERT_EQ(run("whole", rates, "rate").status, 0);
  expect(0, "a", {"--plan"});
  EXPECT_EQ(words_in(folder_ / "a/plan.csv", "run"), (std::vector<std::string>{"1", "2", "3", "4"}));
  EXPECT_EQ(words_in(folder_ / "a/plan.csv", "specimen_of_run"),
            (std::vector<std::string>{"1", "2", "1", "2"}));
  EXPECT_EQ(words_in(folder_ / "a/plan.csv", "folder").at(3), "runs/rate_4_seed_4");
  EXPECT_TRUE(
      contains(content_of(folder_ / "a/plan.csv"), "; Loading/Axial rate = 4 m/s; Scene/Seed = 4\"\n"));
  EXPECT_TRUE(fs::is_empty(folder_ / "a/runs")); // nothing is run
  for (const char *number : {"4", "02", "1", "3"})
    expect(0, "a", {"--run", number});
  expect(0, "a", {"--collect"});
  expect_same("whole", "a");
  const auto head = [&](const std::string &name) {
    const std::string text = content_of(folder_ / name / "costs.csv");
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(head("a"), head("whole"));
  EXPECT_EQ(lines_in(folder_ / "a/costs.csv"), 5);
  EXPECT_EQ(summary_in(folder_ / "a")["status"], "done");
  EXPECT_TRUE(summary_in(folder_ / "a")["wall_seconds"].is_null());
  // What is done is left, and what is collected once more is the same.
  const auto before = fs::last_write_time(folder_ / "a/runs/rate_2_seed_3/history.csv");
  expect(0, "a", {"--run", "1"});
  EXPECT_EQ(fs::last_write_time(folder_ / "a/runs/rate_2_seed_3/history.csv"), before);
  expect(0, "a", {"--collect"});
  expect_same("whole", "a");
}

TEST_F(PlannedStudy, is_ended_by_one_process_that_resumes_it) {
  ASSERT_EQ(run("whole", rates, "rate").status, 0);
  expect(0, "a", {"--plan"});
  expect(0, "a", {"--run", "4"});
  const Outcome rest = run("a", with(rates, "--resume"), "rate");
  EXPECT_EQ(rest.status, 0) << rest.error;
  EXPECT_TRUE(contains(content_of(folder_ / "a/run.log"), "4 of 4  rate_4_seed_4"));
  EXPECT_TRUE(contains(content_of(folder_ / "a/run.log"), ", kept"));
  expect_same("whole", "a");
  expect(0, "a", {"--collect"});
  expect_same("whole", "a");
}

// One run that can be met on the way.
const std::vector<std::string> slow{"-s", "Study/Sphere radius list = 2 mm, 0.9 mm"};
const char *const met = "sphere_radius_0.9_mm_seed_3"; // run 3

pid_t child_of(pid_t parent) {
  std::ifstream children("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  pid_t child = -1;
  children >> child;
  return children ? child : -1;
}

class MetStudy : public PlannedStudy {
protected:
  MetStudy() : inner_(folder_ / "a/runs" / met) {
    EXPECT_EQ(run("whole", slow).status, 0);
    expect(0, "a", {"--plan"}, "size", slow);
    for (const char *number : {"1", "2", "4"})
      expect(0, "a", {"--run", number}, "size", slow);
  }
  std::vector<std::string> third() const { return command("a", with(with(slow, "--run"), "3")); }
  bool at_work(Program &program, long rows) const {
    return program.wait_until([&] { return lines_in(inner_ / "history.csv") >= rows; });
  }
  void expect_whole() const {
    expect(0, "a", {"--run", "3"}, "size", slow);
    expect(0, "a", {"--collect"}, "size", slow);
    expect_same("whole", "a");
    EXPECT_FALSE(fs::exists(folder_ / "a/runs" / (std::string(met) + ".run.json")));
  }
  const fs::path inner_;
};

TEST_F(MetStudy, a_run_that_is_stopped_or_killed_goes_on_to_the_same_bytes) {
  long rows = 20; // more than it had before, so that each is met at work
  for (const int signal : {SIGTERM, SIGINT}) {
    Program program(third(), folder_);
    ASSERT_TRUE(at_work(program, rows)) << content_of(folder_ / "error.txt");
    program.send(signal);
    EXPECT_EQ(program.wait(), 128 + signal);
    EXPECT_EQ(summary_in(inner_)["status"], "stopped");
    rows = lines_in(inner_ / "history.csv") + 5;
  }
  {
    const Outcome early = asked("a", {"--collect"}, "size", slow);
    EXPECT_EQ(early.status, 3);
    EXPECT_TRUE(contains(early.error, std::string("3 of 4  ") + met + ": missing, stopped")) << early.error;
  }
  Program program(third(), folder_);
  ASSERT_TRUE(at_work(program, rows)) << content_of(folder_ / "error.txt");
  const pid_t child = child_of(program.id());
  ASSERT_GT(child, 0);
  program.send(SIGSTOP);
  kill(child, SIGKILL); // as a batch system kills: both, at any moment
  program.send(SIGKILL);
  EXPECT_EQ(program.wait(), -SIGKILL);
  const Outcome early = asked("a", {"--collect"}, "size", slow);
  EXPECT_EQ(early.status, 3);
  EXPECT_TRUE(contains(early.error, std::string(met) + ": missing, ")) << early.error;
  expect_whole();
  EXPECT_TRUE(contains(content_of(inner_ / "run.log"), "resumed at step"));
}

// The run itself goes on for a moment, to write its checkpoint; the next waits for it.
TEST_F(MetStudy, one_whose_study_is_killed_goes_on_at_once) {
  Program program(third(), folder_);
  ASSERT_TRUE(at_work(program, 20)) << content_of(folder_ / "error.txt");
  program.send(SIGKILL);
  EXPECT_EQ(program.wait(), -SIGKILL);
  expect_whole();
}

TEST_F(MetStudy, two_at_once_for_the_same_run_are_one_and_a_refusal) {
  Program program(third(), folder_);
  ASSERT_TRUE(at_work(program, 20)) << content_of(folder_ / "error.txt");
  const pid_t child = child_of(program.id());
  ASSERT_GT(child, 0);
  for (const pid_t process : {program.id(), child})
    kill(process, SIGSTOP); // else it might end while the other waits for it
  expect_refused(std::string("run 3 of the plan, ") + met + ", is at work already", "a", {"--run", "3"},
                 "size", slow);
  expect(0, "a", {"--run", "4"}, "size", slow); // another is done meanwhile
  const Outcome early = asked("a", {"--collect"}, "size", slow);
  EXPECT_EQ(early.status, 3);
  EXPECT_TRUE(contains(early.error, std::string("3 of 4  ") + met + ": missing, at work")) << early.error;
  EXPECT_TRUE(contains(early.error, "1 of 4 runs are missing: 3. Make them with: platen-study size"))
      << early.error;
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "status"),
            (std::vector<std::string>{"done", "done", "missing", "done"}));
  expect_refused("another run is at work in it", "a", {"--plan", "--overwrite"}, "size", slow);
  for (const pid_t process : {program.id(), child})
    kill(process, SIGCONT);
  EXPECT_EQ(program.wait(), 0);
  expect_whole();
}

TEST_F(PlannedStudy, that_is_damaged_is_refused_and_written_anew_when_asked) {
  expect(0, "a", {"--plan"});
  expect(0, "a", {"--run", "2"});
  const fs::path csv = folder_ / "a/plan.csv", json = folder_ / "a/plan.json",
                 scene = folder_ / "a/scene.prm";
  const std::string rows = content_of(csv), plan = content_of(json), text = content_of(scene);
  std::string other_rows = rows;
  other_rows.replace(other_rows.find("rate = 4"), 8, "rate = 5");
  struct Damage {
    fs::path file;
    std::string content, says;
  };
  const Damage all[] = {{csv, other_rows, "plan.csv: is not as it was planned"},
                        {csv, rows.substr(0, rows.size() / 2), "plan.csv: is not as it was planned"},
                        {csv, "", "plan.csv: is not as it was planned"},
                        {json, plan.substr(0, 100), "plan.json: error: is damaged"},
                        {scene, text + "\n", "scene.prm: is not as it was planned"}};
  for (const Damage &damage : all) {
    put(damage.file, damage.content);
    expect_refused(damage.says, "a", {"--run", "3"});
    expect_refused(damage.says, "a", {"--collect"});
    EXPECT_FALSE(fs::exists(folder_ / "a/study.csv"));
    const Outcome again = asked("a", {"--plan"});
    EXPECT_EQ(again.status, 0) << again.error;
    EXPECT_TRUE(contains(again.error, "the plan is written anew")) << again.error;
    EXPECT_EQ(content_of(csv) + content_of(json) + content_of(scene), rows + plan + text);
  }
  std::string other_plan = plan;
  put(json, other_plan.replace(other_plan.find("\"runs\": 4"), 9, "\"runs\": 5"));
  for (const char *what : {"--run=3", "--collect", "--plan"})
    expect_refused("has other runs", "a", {what});
  put(json, plan);
  fs::remove(csv);
  expect_refused("plan.csv: is missing. Write it anew with: platen-study rate", "a", {"--run", "3"});
  expect(0, "a", {"--plan"});
  expect(0, "a", {"--run", "3"});
  fs::remove(json);
  expect_refused("plan.json: error: is missing: the study has no plan", "a", {"--run", "3"});
  expect_refused("holds an earlier run", "a", {"--plan"}); // of what, nothing says
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/rate_2_seed_4/summary.json"));
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/rate_4_seed_3/summary.json"));
}

TEST_F(PlannedStudy, of_another_scene_kind_version_or_file_is_refused_by_what_differs) {
  put(folder_ / "aggregate.txt", "1\n2\n3\n");
  std::vector<std::string> options = rates;
  for (const std::string &entry :
       {std::string("Phases/By = file"), "Phases/File = " + (folder_ / "aggregate.txt").string()})
    options.insert(options.end(), {"-s", entry});
  expect(0, "a", {"--plan"}, "rate", options);
  expect(0, "a", {"--run", "1"}, "rate", options);
  const std::string one = content_of(folder_ / "a/plan.csv");
  std::vector<std::string> other = options;
  other.insert(other.end(), {"-s", "Bond/Modulus = 21 GPa"});
  for (const char *what : {"--plan", "--collect", "--run=2"}) {
    expect_refused("is of another scene: Bond/Modulus was \"", "a", {what}, "rate", other);
    expect_refused("is of a study of rate", "a", {what}, "size", options);
  }
  put(folder_ / "aggregate.txt", "1\n2\n4\n");
  for (const char *what : {"--plan", "--collect", "--run=2"})
    expect_refused("what Phases/File names has changed", "a", {what}, "rate", options);
  put(folder_ / "aggregate.txt", "1\n2\n3\n");
  const fs::path json = folder_ / "a/plan.json";
  const std::string plan = content_of(json);
  Json older = Json::parse(plan);
  older["version"] = "Platen 0.0.9";
  write_summary(json, older);
  for (const char *what : {"--plan", "--collect", "--run=2"})
    expect_refused("was made by Platen 0.0.9, this is Platen", "a", {what}, "rate", options);
  put(json, plan);
  EXPECT_EQ(content_of(folder_ / "a/plan.csv"), one);
  expect(0, "a", {"--run", "2"}, "rate", options);
  // A new plan over it, when asked: nothing of the runs before is left.
  expect(0, "a", {"--plan", "--overwrite"}, "rate", other);
  EXPECT_TRUE(fs::is_empty(folder_ / "a/runs"));
  expect(0, "a", {"--run", "2"}, "rate", other);
}

// Of another version, as where programs on nodes differ; or cut off.
TEST_F(PlannedStudy, takes_no_run_of_another_version_or_that_is_damaged) {
  expect(0, "a", {"--plan"});
  expect(0, "a", {"--run", "1"});
  const fs::path run = folder_ / "a/runs/rate_2_seed_3", summary = run / "summary.json";
  const auto before = results_in(run);
  const std::string text = content_of(summary);
  const auto made_again = [&](const std::string &why) {
    const Outcome collected = asked("a", {"--collect"});
    EXPECT_EQ(collected.status, 3);
    EXPECT_TRUE(contains(collected.error, "rate_2_seed_3: missing, " + why)) << collected.error;
    const Outcome again = asked("a", {"--run", "1"});
    EXPECT_EQ(again.status, 0) << again.error;
    EXPECT_TRUE(contains(again.error, "rate_2_seed_3: is made again: " + why)) << again.error;
    EXPECT_EQ(difference(before, results_in(run)), "");
  };
  Json older = Json::parse(text);
  older["version"] = "Platen 0.0.9";
  write_summary(summary, older);
  made_again("it was made by Platen 0.0.9, this is Platen");
  put(summary, text.substr(0, 700));
  made_again("summary.json is damaged");
}

TEST_F(PlannedStudy, refuses_a_number_that_is_not_in_it) {
  expect_refused("plan.json: error: is missing: the study has no plan. Make one with: platen-study rate", "a",
                 {"--run", "1"});
  EXPECT_FALSE(fs::exists(folder_ / "a"));
  expect(0, "a", {"--plan"});
  expect_refused("--run = 5 is not in the plan. Allowed: 1 ... 4.", "a", {"--run", "5"});
  expect_refused("--run = 0 is no whole number. Allowed: 1 ...", "a", {"--run", "0"});
  EXPECT_TRUE(fs::is_empty(folder_ / "a/runs"));
}

TEST_F(PlannedStudy, tells_what_is_missing_and_what_has_failed) {
  // One step for all: above the limit of the smaller spheres, found when their run is set up.
  const std::vector<std::string> step{"-s", "Integration/Time step = 2.4e-7 s"};
  ASSERT_EQ(run("whole", step).status, 0);
  expect(0, "a", {"--plan"}, "size", step);
  const Outcome none = asked("a", {"--collect"}, "size", step);
  EXPECT_EQ(none.status, 3);
  EXPECT_TRUE(contains(none.error, "4 of 4 runs are missing: 1-4.")) << none.error;
  EXPECT_EQ(json("a")["status"], "stopped");
  EXPECT_EQ(json("a")["missing_runs"], 4);
  expect(0, "a", {"--run", "1"}, "size", step);
  const Outcome failed = asked("a", {"--run", "3"}, "size", step);
  EXPECT_EQ(failed.status, 2);
  EXPECT_TRUE(contains(failed.error, "Integration/Time step")) << failed.error;
  const Outcome some = asked("a", {"--collect"}, "size", step);
  EXPECT_EQ(some.status, 3);
  EXPECT_TRUE(contains(some.error, "2 of 4  sphere_radius_2_mm_seed_4: missing, not begun")) << some.error;
  EXPECT_TRUE(contains(some.error, "3 of 4  sphere_radius_1.4_mm_seed_3: failed, exit status 2: "))
      << some.error;
  EXPECT_TRUE(contains(some.error, "2 of 4 runs are missing: 2,4.")) << some.error;
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "status"),
            (std::vector<std::string>{"done", "missing", "failed", "missing"}));
  expect(0, "a", {"--run", "2"}, "size", step);
  expect(2, "a", {"--run", "4"}, "size", step);
  // With what has failed it ends as one process does: told, counted, in no mean.
  const Outcome all = asked("a", {"--collect"}, "size", step);
  EXPECT_EQ(all.status, 0) << all.error;
  EXPECT_TRUE(contains(all.error, "2 of 4 runs failed")) << all.error;
  expect_same("whole", "a");
}

TEST_F(PlannedStudy, asks_of_each_run_what_the_scene_expects) {
  const std::vector<std::string> few{"-s", "Expect/particles = ... 150"};
  expect(0, "a", {"--plan"}, "size", few);
  expect(0, "a", {"--run", "1"}, "size", few);
  expect(0, "a", {"--run", "2"}, "size", few);
  expect(1, "a", {"--run", "3"}, "size", few);
  expect(1, "a", {"--run", "4"}, "size", few);
  expect(1, "a", {"--run", "4"}, "size", few); // left as it is, and told again
  expect(1, "a", {"--collect"}, "size", few);
  EXPECT_EQ(summary_in(folder_ / "a")["missed"].size(), 2u);
}

TEST_F(PlannedStudy, leaves_alone_what_another_run_or_a_user_has_there) {
  ASSERT_EQ(run("a", rates, "rate").status, 0);
  expect_refused("holds an earlier run", "a", {"--plan"});
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/rate_2_seed_3/summary.json"));
  put(folder_ / "a/runs/notes/of_the_user.txt", "kept");
  expect(0, "a", {"--plan", "--overwrite"});
  EXPECT_FALSE(fs::exists(folder_ / "a/runs/rate_2_seed_3"));
  EXPECT_FALSE(fs::exists(folder_ / "a/study.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/notes/of_the_user.txt"));
}

} // namespace
} // namespace platen::apps::testing
