// A study made run by run: by whom, in what order and however often it is stopped, it leaves the bytes of one
// process.
#include <gtest/gtest.h>
#include <unistd.h>

#include "apps/output/summary.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

class PlannedStudy : public Study {
protected:
  // Four runs, two on each packing, in the folder `a`.
  std::string kind_ = "rate";
  Words options_ = set({"Study/Axial rate list = 2 m/s, 4 m/s"});

  void ask(int status, const Words &what, const std::string &says = "") const {
    expect(status, says, "a", with(options_, what), kind_);
  }
  void make_whole() const { make_once("whole", options_, kind_); }
  void expect_same() const {
    expect_same_tables("whole", "a");
    for (const auto &entry : fs::directory_iterator(folder_ / "whole/runs"))
      EXPECT_EQ(
          difference(results_in(entry.path()), results_in(folder_ / "a/runs" / entry.path().filename())), "")
          << entry.path();
  }
};

TEST_F(PlannedStudy, made_in_any_order_leaves_the_bytes_of_one_process) {
  make_whole();
  ask(0, {"--plan"});
  EXPECT_EQ(words_in(folder_ / "a/plan.csv", "run"), (Words{"1", "2", "3", "4"}));
  EXPECT_EQ(words_in(folder_ / "a/plan.csv", "specimen_of_run"), (Words{"1", "2", "1", "2"}));
  EXPECT_EQ(words_in(folder_ / "a/plan.csv", "folder").at(3), "runs/rate_4_seed_4");
  EXPECT_TRUE(
      contains(content_of(folder_ / "a/plan.csv"), "; Loading/Axial rate = 4 m/s; Scene/Seed = 4\"\n"));
  EXPECT_TRUE(fs::is_empty(folder_ / "a/runs")); // nothing is run
  for (const char *number : {"4", "02", "1", "3"})
    ask(0, {"--run", number});
  ask(0, {"--collect"});
  expect_same();
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
  ask(0, {"--run", "1"});
  EXPECT_EQ(fs::last_write_time(folder_ / "a/runs/rate_2_seed_3/history.csv"), before);
  ask(0, {"--collect"});
  expect_same();
}

TEST_F(PlannedStudy, is_ended_by_one_process_that_resumes_it) {
  make_whole();
  ask(0, {"--plan"});
  ask(0, {"--run", "4"});
  ask(0, {"--resume"});
  EXPECT_TRUE(contains(content_of(folder_ / "a/run.log"), "4 of 4  rate_4_seed_4"));
  EXPECT_TRUE(contains(content_of(folder_ / "a/run.log"), ", kept"));
  expect_same();
  ask(0, {"--collect"});
  expect_same();
}

// All are done but the one that can be met on the way.
class MetStudy : public PlannedStudy {
protected:
  MetStudy() : inner_(folder_ / "a/runs" / met_at_work) {
    kind_ = "size", options_ = slow;
    make_whole();
    ask(0, {"--plan"});
    for (const char *number : {"1", "2", "4"})
      ask(0, {"--run", number});
  }
  Words third() const { return command("a", with(options_, {"--run", "3"})); }
  bool at_work(Program &program, long rows = 20) const {
    return program.wait_until([&] { return lines_in(inner_ / "history.csv") >= rows; });
  }
  void expect_whole() const {
    ask(0, {"--run", "3"});
    ask(0, {"--collect"});
    expect_same();
    EXPECT_FALSE(fs::exists(folder_ / "a/runs" / (std::string(met_at_work) + ".run.json")));
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
  ask(3, {"--collect"}, std::string("3 of 4  ") + met_at_work + ": missing, stopped");
  Program program(third(), folder_);
  ASSERT_TRUE(at_work(program, rows)) << content_of(folder_ / "error.txt");
  const pid_t child = child_of(program.id());
  ASSERT_GT(child, 0);
  program.send(SIGSTOP);
  kill(child, SIGKILL); // as a batch system kills: both, at any moment
  program.send(SIGKILL);
  EXPECT_EQ(program.wait(), -SIGKILL);
  ask(3, {"--collect"}, std::string(met_at_work) + ": missing, ");
  expect_whole();
  EXPECT_TRUE(contains(content_of(inner_ / "run.log"), "resumed at step"));
}

// The run itself goes on for a moment, to write its checkpoint; the next waits for it.
TEST_F(MetStudy, one_whose_study_is_killed_goes_on_at_once) {
  Program program(third(), folder_);
  ASSERT_TRUE(at_work(program)) << content_of(folder_ / "error.txt");
  program.send(SIGKILL);
  EXPECT_EQ(program.wait(), -SIGKILL);
  expect_whole();
}

TEST_F(MetStudy, two_at_once_for_the_same_run_are_one_and_a_refusal) {
  Program program(third(), folder_);
  ASSERT_TRUE(at_work(program)) << content_of(folder_ / "error.txt");
  const pid_t child = child_of(program.id());
  ASSERT_GT(child, 0);
  for (const pid_t process : {program.id(), child})
    kill(process, SIGSTOP); // else it might end while the other waits for it
  ask(2, {"--run", "3"}, std::string("run 3 of the plan, ") + met_at_work + ", is at work already");
  ask(0, {"--run", "4"}); // another is done meanwhile
  ask(3, {"--collect"}, std::string("3 of 4  ") + met_at_work + ": missing, at work");
  EXPECT_TRUE(contains(content_of(folder_ / "error.txt"),
                       "1 of 4 runs are missing: 3. Make them with: platen-study size"));
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "status"), (Words{"done", "done", "missing", "done"}));
  ask(2, {"--plan", "--overwrite"}, "another run is at work in it");
  for (const pid_t process : {program.id(), child})
    kill(process, SIGCONT);
  EXPECT_EQ(program.wait(), 0);
  expect_whole();
}

TEST_F(PlannedStudy, that_is_damaged_is_refused_and_written_anew_when_asked) {
  ask(0, {"--plan"});
  ask(0, {"--run", "2"});
  const fs::path csv = folder_ / "a/plan.csv", json = folder_ / "a/plan.json",
                 scene = folder_ / "a/scene.prm";
  const std::string rows = content_of(csv), plan = content_of(json), text = content_of(scene);
  std::string other_rows = rows, other_plan = plan;
  other_rows.replace(other_rows.find("rate = 4"), 8, "rate = 5");
  other_plan.replace(other_plan.find("\"runs\": 4"), 9, "\"runs\": 5");
  struct Damage {
    fs::path file;
    std::string content, says;
  };
  const Damage all[] = {{csv, other_rows, "plan.csv: is not as it was planned"},
                        {csv, rows.substr(0, rows.size() / 2), "plan.csv: is not as it was planned"},
                        {csv, "", "plan.csv: is not as it was planned"},
                        {json, plan.substr(0, 100), "plan.json: is damaged"},
                        {scene, text + "\n", "scene.prm: is not as it was planned"}};
  for (const Damage &damage : all) {
    put(damage.file, damage.content);
    ask(2, {"--run", "3"}, damage.says);
    ask(2, {"--collect"}, damage.says);
    EXPECT_FALSE(fs::exists(folder_ / "a/study.csv"));
    ask(0, {"--plan"}, "the plan is written anew");
    EXPECT_EQ(content_of(csv) + content_of(json) + content_of(scene), rows + plan + text);
  }
  put(json, other_plan);
  for (const char *what : {"--run=3", "--collect", "--plan"})
    ask(2, {what}, "has other runs");
  put(json, plan);
  fs::remove(csv);
  ask(2, {"--run", "3"}, "plan.csv: is missing. Write it anew with: platen-study rate");
  ask(0, {"--plan"});
  ask(0, {"--run", "3"});
  fs::remove(json);
  ask(2, {"--run", "3"}, "plan.json: error: is missing: the study has no plan");
  ask(2, {"--plan"}, "holds an earlier run"); // of what, nothing says
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/rate_2_seed_4/summary.json"));
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/rate_4_seed_3/summary.json"));
}

TEST_F(PlannedStudy, of_another_scene_kind_version_or_file_is_refused_by_what_differs) {
  const fs::path aggregate = folder_ / "aggregate.txt", json = folder_ / "a/plan.json";
  const Words other = set({"Bond/Modulus = 21 GPa"});
  options_ = with(options_, set({"Phases/By = file", "Phases/File = " + aggregate.string()}));
  put(aggregate, "1\n2\n3\n");
  ask(0, {"--plan"});
  ask(0, {"--run", "1"});
  const std::string one = content_of(folder_ / "a/plan.csv"), plan = content_of(json);
  const auto refused = [&](const std::string &says, const Words &more = {}) {
    for (const char *what : {"--plan", "--collect", "--run=2"})
      ask(2, with(more, {what}), says);
  };
  refused("is of another scene: Bond/Modulus was \"", other);
  kind_ = "size";
  refused("is of a study of rate");
  kind_ = "rate";
  put(aggregate, "1\n2\n4\n");
  refused("what Phases/File names has changed");
  put(aggregate, "1\n2\n3\n");
  Json older = Json::parse(plan);
  older["version"] = "Platen 0.0.9";
  write_summary(json, older);
  refused("was made by Platen 0.0.9, this is Platen");
  put(json, plan);
  EXPECT_EQ(content_of(folder_ / "a/plan.csv"), one);
  ask(0, {"--run", "2"});
  // A new plan over it, when asked: nothing of the runs before is left.
  ask(0, with(other, {"--plan", "--overwrite"}));
  EXPECT_TRUE(fs::is_empty(folder_ / "a/runs"));
  ask(0, with(other, {"--run", "2"}));
}

// Of another version, as where programs on nodes differ; or cut off.
TEST_F(PlannedStudy, takes_no_run_of_another_version_or_that_is_damaged) {
  ask(0, {"--plan"});
  ask(0, {"--run", "1"});
  const fs::path run = folder_ / "a/runs/rate_2_seed_3", summary = run / "summary.json";
  const auto before = results_in(run);
  const std::string text = content_of(summary);
  const auto made_again = [&](const std::string &why) {
    ask(3, {"--collect"}, "rate_2_seed_3: missing, " + why);
    ask(0, {"--run", "1"}, "rate_2_seed_3: is made again: " + why);
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
  ask(2, {"--run", "1"},
      "plan.json: error: is missing: the study has no plan. Make one with: platen-study rate");
  EXPECT_FALSE(fs::exists(folder_ / "a"));
  ask(0, {"--plan"});
  ask(2, {"--run", "5"}, "--run = 5 is not in the plan. Allowed: 1 ... 4.");
  ask(2, {"--run", "0"}, "--run = 0 is out of range. Allowed: 1 ...");
  EXPECT_TRUE(fs::is_empty(folder_ / "a/runs"));
}

TEST_F(PlannedStudy, tells_what_is_missing_and_what_has_failed) {
  // One step for all: above the limit of the smaller spheres, found when their run is set up.
  kind_ = "size", options_ = set({"Integration/Time step = 2.4e-7 s"});
  make_whole();
  ask(0, {"--plan"});
  ask(3, {"--collect"}, "4 of 4 runs are missing: 1-4.");
  EXPECT_EQ(json("a")["status"], "stopped");
  EXPECT_EQ(json("a")["missing_runs"], 4);
  ask(0, {"--run", "1"});
  ask(2, {"--run", "3"}, "Integration/Time step");
  for (const char *says :
       {"2 of 4  sphere_radius_2_mm_seed_4: missing, not begun",
        "3 of 4  sphere_radius_1.4_mm_seed_3: failed, exit status 2: ", "2 of 4 runs are missing: 2,4."})
    ask(3, {"--collect"}, says);
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "status"), (Words{"done", "missing", "failed", "missing"}));
  ask(0, {"--run", "2"});
  ask(2, {"--run", "4"});
  // With what has failed it ends as one process does: told, counted, in no mean.
  ask(0, {"--collect"}, "2 of 4 runs failed");
  expect_same();
}

TEST_F(PlannedStudy, asks_of_each_run_what_the_scene_expects) {
  kind_ = "size", options_ = set({"Expect/particles = ... 150"});
  ask(0, {"--plan"});
  ask(0, {"--run", "1"});
  ask(0, {"--run", "2"});
  ask(1, {"--run", "3"});
  ask(1, {"--run", "4"});
  ask(1, {"--run", "4"}); // left as it is, and told again
  ask(1, {"--collect"});
  EXPECT_EQ(summary_in(folder_ / "a")["missed"].size(), 2u);
}

TEST_F(PlannedStudy, leaves_alone_what_another_run_or_a_user_has_there) {
  ask(0, {});
  ask(2, {"--plan"}, "holds an earlier run");
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/rate_2_seed_3/summary.json"));
  put(folder_ / "a/runs/notes/of_the_user.txt", "kept");
  ask(0, {"--plan", "--overwrite"});
  EXPECT_FALSE(fs::exists(folder_ / "a/runs/rate_2_seed_3"));
  EXPECT_FALSE(fs::exists(folder_ / "a/study.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/notes/of_the_user.txt"));
}

} // namespace
} // namespace platen::apps::testing
