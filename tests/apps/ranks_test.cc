// One specimen over several ranks of mpirun: neither their number nor threads, stops or late messages change
// a byte of what a run finds. And bad days: what is refused, stopped, killed or fails under way, as a user
// sees it.
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <set>
#include <sstream>

#include "apps/on_ranks.h"
#include "apps/run/ranks.h"

namespace platen::apps::testing {
namespace {

class Ranks : public OnRanks {
protected:
  // A run worth comparing: failure of both kinds, frames, more blocks than two ranks.
  void require_crushed(const fs::path &run) const {
    const nlohmann::json found = summary_in(run);
    EXPECT_GT(found["particles"], 1024);
    EXPECT_GT(found["broken_tension"], 300);
    EXPECT_GT(found["broken_shear"], 10);
    EXPECT_GT(lines_in(run / "specimen.pvd"), 6);
  }
};

TEST_F(Ranks, their_number_threads_and_late_messages_change_no_byte) {
  require_crushed(whole());
  run_on(2, "two", {"-t", "2"});
  EXPECT_EQ(unlike(whole(), "two"), "");
  run_on(3, "three", {}, true);
  EXPECT_EQ(unlike(whole(), "three"), "");
}

// What ends it is seen in a row of history.csv, for which less is gathered than for the last frame.
TEST_F(Ranks, a_test_that_ends_at_a_share_of_its_peak_ends_in_the_same_bytes) {
  const std::vector<std::string> fallen{"-s", "Loading/Stop at residual = 0.7", "-s",
                                        "Loading/Target strain = 0.02"};
  EXPECT_EQ(summary_in(whole(fallen))["ended_by"], "stop at residual");
  run_on(2, "two", fallen);
  EXPECT_EQ(unlike(whole(fallen), "two"), "");
}

TEST_F(Ranks, elastic_platens_and_a_sleeve_change_no_byte) {
  const std::vector<std::string> around{"-s", "Platens/Kind = deformable",
                                        "-s", "Loading/Confinement = sleeve",
                                        "-s", "Loading/Confining pressure = 20 MPa",
                                        "-s", "Loading/Confining ramp = 0.02 ms",
                                        "-s", "Sleeve/Thickness = 1 mm",
                                        "-s", "Loading/Target strain = 0.003"};
  const fs::path one = whole(around);
  EXPECT_GT(summary_in(one)["broken_tension"], 10);
  run_on(3, "three", around);
  EXPECT_EQ(unlike(one, "three"), "");
}

TEST_F(Ranks, a_tube_that_yields_and_comes_off_changes_no_byte) {
  std::vector<std::string> around{
      "-s", "Loading/Confinement = sleeve", "-s", "Sleeve/Kind = tube",
      "-s", "Sleeve/Steel = S235",          "-s", "Sleeve/Yield strength = 40 MPa",
      "-s", "Sleeve/Thickness = 0.5 mm",    "-s", "Loading/Target strain = 0.004"};
  const fs::path one = whole(around);
  EXPECT_GT(summary_in(one)["tube_plastic_work_j"], 0);
  run_on(3, "three", around);
  EXPECT_EQ(unlike(one, "three"), "");
  around.insert(around.end(), {"-s", "Sleeve/Bond strength = 10 MPa", "-s", "Sleeve/Bond slip = 2 um"});
  const fs::path bonded = whole(around);
  const double share = summary_in(bonded)["tube_bonded_share"];
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 0.9);
  run_on(3, "bonded", around);
  EXPECT_EQ(unlike(bonded, "bonded"), "");
}

TEST_F(Ranks, a_wrap_that_tears_changes_no_byte) {
  const std::vector<std::string> around{
      "-s", "Loading/Confinement = sleeve", "-s", "Sleeve/Kind = wrap",
      "-s", "Sleeve/Modulus = 70 GPa",      "-s", "Sleeve/Rupture strain = 0.0005",
      "-s", "Sleeve/Thickness = 0.1 mm",    "-s", "Loading/Target strain = 0.006"};
  const fs::path one = whole(around);
  EXPECT_GT(summary_in(one)["wrap_torn_energy_j"], 0);
  run_on(3, "three", around);
  EXPECT_EQ(unlike(one, "three"), "");
}

// Its areas are found anew in every 400th step, in which many bonds break: ranks know only of those before.
TEST_F(Ranks, a_pressed_skin_with_pieces_that_come_loose_changes_no_byte) {
  const std::vector<std::string> around{
      "-s", "Loading/Confinement = particles",  "-s", "Loading/Confining pressure = 5 MPa",
      "-s", "Loading/Confining ramp = 0.02 ms", "-s", "Specimen/Sphere radius = 0.7 mm",
      "-s", "Loading/Axial rate = 4 m/s",       "-s", "Loading/Target strain = 0.008"};
  const fs::path one = whole(around);
  EXPECT_GT(summary_in(one)["steps"], 400);
  EXPECT_GT(summary_in(one)["broken_tension"], 3000);
  run_on(3, "three", around);
  EXPECT_EQ(unlike(one, "three"), "");
}

TEST_F(Ranks, a_run_resumed_on_four_three_one_and_seven_ranks_ends_as_if_it_had_not_been_stopped) {
  const auto part = [&](int ranks, long rows, const std::vector<std::string> &more) {
    const auto command = crush("stopped", more);
    return disturb(ranks == 1 ? command : on(ranks, command), "stopped", rows, [&](Program &program) {
      kill(ranks == 1 ? program.id() : process_of_rank(program.id(), ranks - 1), SIGTERM);
    });
  };
  ASSERT_EQ(part(4, 8, {}), 143) << said();
  EXPECT_EQ(summary_in(folder_ / "stopped")["status"], "stopped");
  ASSERT_EQ(part(3, 24, {"--resume"}), 143) << said();
  ASSERT_EQ(part(1, 40, {"--resume"}), 143) << said();
  run_on(7, "stopped", {"--resume"});
  EXPECT_EQ(unlike(whole(), "stopped"), "");
}

// Failed rows of laws that remember are put behind whole ones as a run goes on.
TEST_F(Ranks, failed_bonds_stopped_on_one_and_resumed_on_three_end_in_the_same_bytes) {
  const std::vector<std::string> yielding{"-s", "Effects/Bond = yielding parallel bond"},
      facets{"-s", "Effects/Bond = facet",         "-s", "Bond/Tensile strength = 4 MPa",
             "-s", "Bond/Shear strength = 11 MPa", "-s", "Bond/Fracture energy = 5 J/m2",
             "-s", "Bond/Friction dynamic = 0.6",  "-s", "Bond/Gap = 0.6 R_min"};
  for (std::vector<std::string> law : {yielding, facets}) {
    SCOPED_TRACE(law[1]);
    for (const char *entry :
         {"Compression limits = 20 MPa, 45 MPa, 70 MPa", "Compression slopes = 3, 12, 22"})
      law.insert(law.end(), {"-s", std::string("Bond/") + entry});
    const std::string stopped = "stopped " + law[1];
    const fs::path one = whole(law);
    EXPECT_GT(summary_in(one)["broken_tension"], 300);
    const int status =
        disturb(crush(stopped, law), stopped, 40, [](Program &program) { kill(program.id(), SIGTERM); });
    ASSERT_EQ(status, 143) << said();
    law.emplace_back("--resume");
    run_on(3, stopped, law);
    EXPECT_EQ(unlike(one, stopped), "");
  }
}

// Ranks of which this one has `own`, as the others have `others`.
struct Fake : dem::Exchange {
  explicit Fake(std::vector<dem::InstructionSet> of_others) : others(std::move(of_others)) {}
  std::vector<dem::InstructionSet> others;
  dem::OwnBlocks none;
  int ranks() const override { return 1 + static_cast<int>(others.size()); }
  const dem::OwnBlocks &blocks() const override { return none; }
  void progress() override {}
  void send_to_all(const std::vector<char> &, std::size_t) override {}
  std::vector<Received> receive_from_all() override { return {}; }
  std::vector<char> all_bytes(const std::vector<char> &own) override { return own; }
  void gather_blocks(void *, std::size_t) override {}
  void sum_up(dem::Model &) override {}
  void send_motion(const dem::Particles &) override {}
  void start_sums(const dem::StepSums &) override {}
  void receive_motion(dem::Particles &) override {}
  dem::StepSums finish_sums() override { return {}; }
  void send_bond_ghosts(const dem::PairBlocks &) override {}
  void send_contact_ghosts(const dem::PairBlocks &) override {}
  void receive_ghosts(dem::PairBlocks *, dem::PairBlocks *) override {}
  void gather_motion(dem::Particles &) override {}
  void renew_contacts(dem::Model &) override {}
  void share_rows(const std::vector<int> *) override {}
  std::vector<dem::Crack> all_cracks(const std::vector<dem::Crack> &own) override { return own; }
  ExactSum all(ExactSum own) override { return own; }
  long all(long own) override { return own; }
  long largest(long own) override {
    for (const dem::InstructionSet set : others)
      own = std::max(own, own < 0 ? -static_cast<long>(set) : static_cast<long>(set));
    return own;
  }
  void gather(dem::Model &) override {}
  void scatter(dem::Model &) override {}
};

TEST(RanksOfUnlikeMachines, all_go_by_the_weakest_instruction_set_and_say_so) {
  using dem::InstructionSet;
  Fake unlike({InstructionSet::avx2, InstructionSet::avx512}), alike({InstructionSet::avx512});
  for (const InstructionSet own : {InstructionSet::avx2, InstructionSet::avx512}) {
    const CommonSet begun = common_instruction_set(own, &unlike, false);
    EXPECT_EQ(begun.set, InstructionSet::avx2);
    EXPECT_EQ(begun.note, "machines of this run have the instruction sets avx512 and avx2: all go by avx2");
    const CommonSet resumed = common_instruction_set(own, &unlike, true);
    EXPECT_EQ(resumed.set, InstructionSet::avx2);
    EXPECT_EQ(resumed.note,
              "machines of this run have the instruction sets avx512 and avx2: all go on with avx2, "
              "and the last digits are no longer those of the part before");
  }
  EXPECT_EQ(common_instruction_set(InstructionSet::avx512, &alike, true).set, InstructionSet::avx512);
  EXPECT_EQ(common_instruction_set(InstructionSet::avx512, &alike, true).note, "");
  EXPECT_EQ(common_instruction_set(InstructionSet::avx512, nullptr, true).note, "");
}

class RankCheckpoints : public OnRanks {};

// They fall between rows and frames, and no rank has gathered them.
TEST_F(RankCheckpoints, are_those_of_one_process_and_any_number_of_ranks_goes_on_from_them) {
  const std::vector<std::string> slowly{
      "-s", "Loading/Axial rate = 0.3 m/s", "-s", "Loading/Target strain = 0.003", "-s", "Output/Every = 20",
      "-s", "Output/Fields every = 400",    "-s", "Checkpoint/Every = 313"};
  std::vector<std::string> resumed = slowly;
  resumed.emplace_back("--resume");
  const fs::path one = whole(slowly);
  EXPECT_GT(lines_in(one / "cracks.csv"), 100);
  run_on(3, "three", slowly);
  EXPECT_EQ(unlike(one, "three"), "");
  std::set<std::string> files;
  for (const auto &file : fs::directory_iterator(one / "checkpoint"))
    files.insert(file.path().filename().string());
  ASSERT_EQ(files.size(), 2u);
  // The last one has the end of its run, which is gathered; the one before does not.
  fs::remove(folder_ / "three/checkpoint" / *files.rbegin());
  fs::copy(folder_ / "three", folder_ / "onward", fs::copy_options::recursive);
  run_on(2, "three", resumed);
  const Outcome onward = run(crush("onward", resumed));
  EXPECT_EQ(onward.status, 0) << onward.error;
  for (const char *name : {"three", "onward"})
    EXPECT_EQ(difference(results_in(one), results_in(folder_ / name)), "") << name;
}

class BadDays : public OnRanks {
protected:
  // The own message stands first, once, and before what mpirun has to say.
  void expect_told_once(const Outcome &outcome, int status, const std::string &part) const {
    EXPECT_EQ(outcome.status, status) << outcome.error;
    std::istringstream lines(outcome.error);
    std::string first;
    while (std::getline(lines, first) && first.rfind("mpiexec: Forwarding signal", 0) == 0) {
    }
    EXPECT_TRUE(contains(first, part)) << "expected first: " << part << "\ncame: " << outcome.error;
    EXPECT_EQ(count_of(outcome.error, part), 1) << outcome.error;
    EXPECT_EQ(count_of(outcome.out + outcome.error, "rank 1: "), 0) << outcome.error;
  }
  std::vector<std::string> app(const std::string &name) const {
    return {(fs::path(PLATEN_COMPRESS_PROGRAM).parent_path() / name).string(), test_scene("crushed.prm"),
            "-o", "none"};
  }
  // Resumed on so many ranks, it ends as the run that nobody disturbed.
  void expect_resumes(const std::string &name, int ranks) const {
    run_on(ranks, name, {"--resume"});
    EXPECT_EQ(unlike_at_end(whole(), name), "") << "resumed on " << ranks;
  }
  // Step of the newest checkpoint; -1 without one.
  long newest_step(const std::string &name) const {
    long newest = -1;
    std::error_code none;
    for (const auto &file : fs::directory_iterator(folder_ / name / "checkpoint", none))
      if (const std::string stem = file.path().filename().string(); !contains(stem, ".part."))
        newest = std::max(newest, std::stol(stem.substr(5)));
    return newest;
  }
};

TEST_F(BadDays, what_is_refused_is_told_once_with_status_2) {
  expect_told_once(run(on(3, crush("none", {"-s", "Specimen/Radius = -10 mm"}))), 2,
                   "Specimen/Radius = -10 mm");
  put(folder_ / "taken/history.csv", "an earlier run\n");
  expect_told_once(run(on(3, crush("taken"))), 2, "output folder taken: ");
  EXPECT_FALSE(fs::exists(folder_ / "none"));
  for (const char *name :
       {"platen-pack", "platen-study", "platen-report", "platen-calibrate", "platen-bonds", "platen-bar"}) {
    std::vector<std::string> command = app(name);
    if (contains(name, "study")) command.insert(command.begin() + 1, "size");
    const Outcome outcome = run(on(2, command));
    expect_told_once(outcome, 2, "mpirun has started 2 processes of " + std::string(name));
    EXPECT_TRUE(contains(outcome.error, "platen-compress and platen-brazilian run on several ranks"));
    EXPECT_FALSE(fs::exists(folder_ / "none")) << name;
  }
}

// Each of these waited for ever, or mixed two tests.
TEST_F(BadDays, ranks_started_with_different_lines_are_refused) {
  const auto beside = [&](const std::vector<std::string> &second) {
    std::vector<std::string> command = on(1, crush("none"));
    command.insert(command.end(), {":", "-n", "1"});
    command.insert(command.end(), second.begin(), second.end());
    expect_told_once(run(command), 2, "ranks were started with different scenes or entries");
    EXPECT_FALSE(fs::exists(folder_ / "none"));
  };
  beside(crush("none", {"-s", "Loading/Target strain = 0.003"}));
  beside(crush("none", {"--dry-run"}));
  beside(crush("none", {"--help"}));
  std::vector<std::string> another = crush("none");
  another[0] = app("platen-brazilian")[0];
  beside(another);
}

// On two machines one name may stand for two files.
TEST_F(BadDays, scenes_of_one_name_with_different_content_are_refused) {
  std::string scene = content_of(test_scene("crushed.prm"));
  put(folder_ / "0/scene.prm", scene);
  const std::string seed = "Seed = 3";
  ASSERT_EQ(count_of(scene, seed), 1);
  put(folder_ / "1/scene.prm", scene.replace(scene.find(seed), seed.size(), "Seed = 4"));
  const std::string go = R"(cd "$OMPI_COMM_WORLD_RANK" && exec "$@")";
  const Outcome outcome = run(
      on(2, {"/bin/sh", "-c", go, "sh", PLATEN_COMPRESS_PROGRAM, "scene.prm", "-o", "results", "--quiet"}));
  expect_told_once(outcome, 2, "ranks were started with different scenes or entries");
  EXPECT_FALSE(fs::exists(folder_ / "0/results"));
}

TEST_F(BadDays, more_ranks_than_blocks_are_warned_of_and_change_no_byte) {
  const std::vector<std::string> entries{"-s", "Loading/Target strain = 0.002"};
  run_on(5, "many", entries);
  EXPECT_TRUE(contains(content_of(folder_ / "many/run.log"),
                       "warning: 2 of 5 ranks have nothing to do: the specimen has 3 blocks of 512 spheres. "
                       "Useful: 3 ranks"));
  EXPECT_EQ(unlike(whole(entries), "many"), "");
}

TEST_F(BadDays, a_stop_asked_of_mpirun_leaves_a_checkpoint) {
  const int status =
      disturb(on(2, crush("stopped")), "stopped", 8, [](Program &program) { program.send(SIGTERM); });
  EXPECT_NE(status, 0); // mpirun's own
  ASSERT_GE(newest_step("stopped"), 0) << said();
  expect_resumes("stopped", 3);
}

TEST_F(BadDays, a_checkpoint_asked_of_any_rank_is_written) {
  for (const int rank : {0, 1}) {
    const std::string name = "asked_" + std::to_string(rank);
    bool written = false;
    const int status =
        disturb(on(2, crush(name, {"-s", "Checkpoint/Every = 1000000"})), name, 4, [&](Program &program) {
          kill(process_of_rank(program.id(), rank), SIGUSR1);
          written = program.wait_until([&] { return newest_step(name) > 0; });
        });
    EXPECT_EQ(status, 0) << said();
    EXPECT_TRUE(written) << rank;
  }
}

TEST_F(BadDays, a_file_that_is_removed_or_cannot_grow_ends_all_once_with_status_4) {
  const auto failing = [&](const std::string &name, const std::string &part, const auto &act) {
    Outcome outcome;
    outcome.status = disturb(on(2, crush(name)), name, 18, act);
    outcome.error = said();
    expect_told_once(outcome, 4, part);
  };
  failing("removed", "error: removed/history.csv: has been removed",
          [&](Program &) { fs::remove(folder_ / "removed/history.csv"); });
  const Outcome lost = run(crush("removed", {"--resume"}));
  EXPECT_EQ(lost.status, 2);
  EXPECT_TRUE(contains(lost.error, "history.csv: error: is missing"));
  failing("full", ": cannot be written: File too large", [&](Program &program) {
    const rlimit few{1000, 1000};
    ASSERT_EQ(prlimit(process_of_rank(program.id(), 0), RLIMIT_FSIZE, &few, nullptr), 0);
  });
  expect_resumes("full", 1);
}

TEST_F(BadDays, a_rank_that_is_killed_ends_all_and_the_run_resumes_on_any_number_of_ranks) {
  for (const int rank : {0, 2}) {
    const std::string name = "killed_" + std::to_string(rank);
    std::chrono::steady_clock::time_point killed;
    const int status = disturb(on(3, crush(name)), name, 30, [&](Program &program) {
      kill(process_of_rank(program.id(), rank), SIGKILL);
      killed = std::chrono::steady_clock::now();
    });
    EXPECT_EQ(status, 128 + SIGKILL);
    EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::seconds(20));
    EXPECT_FALSE(fs::exists(folder_ / name / "summary.json"));
    ASSERT_GE(newest_step(name), 200);
    expect_resumes(name, rank == 0 ? 1 : 2);
  }
}

} // namespace
} // namespace platen::apps::testing
