// One specimen over several ranks of mpirun: neither their number nor threads, stops or late messages change
// a byte of what a run finds.
#include <gtest/gtest.h>
#include <signal.h>

#include "apps/on_ranks.h"
#include "apps/run/ranks.h"

namespace platen::apps::testing {
namespace {

class Ranks : public OnRanks {
protected:
  // A run worth comparing: failure of both kinds, frames, more blocks than two ranks.
  void require_crushed(const std::string &name) const {
    const nlohmann::json found = summary_in(folder_ / name);
    EXPECT_GT(found["particles"], 1024);
    EXPECT_GT(found["broken_tension"], 300);
    EXPECT_GT(found["broken_shear"], 10);
    EXPECT_GT(lines_in(folder_ / name / "specimen.pvd"), 6);
  }
};

TEST_F(Ranks, their_number_threads_and_late_messages_change_no_byte) {
  run_whole("one");
  require_crushed("one");
  run_on(2, "two", {"-t", "2"});
  EXPECT_EQ(unlike("one", "two"), "");
  run_on(3, "three", {}, true);
  EXPECT_EQ(unlike("one", "three"), "");
}

// What ends it is seen in a row of history.csv, for which less is gathered than for the last frame.
TEST_F(Ranks, a_test_that_ends_at_a_share_of_its_peak_ends_in_the_same_bytes) {
  const std::vector<std::string> fallen{"-s", "Loading/Stop at residual = 0.7", "-s",
                                        "Loading/Target strain = 0.02"};
  run_whole("one", fallen);
  EXPECT_EQ(summary_in(folder_ / "one")["ended_by"], "stop at residual");
  run_on(2, "two", fallen);
  EXPECT_EQ(unlike("one", "two"), "");
}

TEST_F(Ranks, elastic_platens_and_a_sleeve_change_no_byte) {
  const std::vector<std::string> around{"-s", "Platens/Kind = deformable",
                                        "-s", "Loading/Confinement = sleeve",
                                        "-s", "Loading/Confining pressure = 20 MPa",
                                        "-s", "Loading/Confining ramp = 0.02 ms",
                                        "-s", "Sleeve/Thickness = 1 mm",
                                        "-s", "Loading/Target strain = 0.003"};
  run_whole("one", around);
  EXPECT_GT(summary_in(folder_ / "one")["broken_tension"], 10);
  run_on(3, "three", around);
  EXPECT_EQ(unlike("one", "three"), "");
}

// Its areas are found anew in every 400th step, in which many bonds break: ranks know only of those before.
TEST_F(Ranks, a_pressed_skin_with_pieces_that_come_loose_changes_no_byte) {
  const std::vector<std::string> around{
      "-s", "Loading/Confinement = particles",  "-s", "Loading/Confining pressure = 5 MPa",
      "-s", "Loading/Confining ramp = 0.02 ms", "-s", "Specimen/Sphere radius = 0.7 mm",
      "-s", "Loading/Axial rate = 4 m/s",       "-s", "Loading/Target strain = 0.008"};
  run_whole("one", around);
  EXPECT_GT(summary_in(folder_ / "one")["steps"], 400);
  EXPECT_GT(summary_in(folder_ / "one")["broken_tension"], 3000);
  run_on(3, "three", around);
  EXPECT_EQ(unlike("one", "three"), "");
}

TEST_F(Ranks, a_run_resumed_on_four_three_one_and_seven_ranks_ends_as_if_it_had_not_been_stopped) {
  run_whole("whole");
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
  EXPECT_EQ(unlike("whole", "stopped"), "");
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
    const std::string whole = "whole " + law[1], stopped = "stopped " + law[1];
    run_whole(whole, law);
    EXPECT_GT(summary_in(folder_ / whole)["broken_tension"], 300);
    const int status =
        disturb(crush(stopped, law), stopped, 40, [](Program &program) { kill(program.id(), SIGTERM); });
    ASSERT_EQ(status, 143) << said();
    law.emplace_back("--resume");
    run_on(3, stopped, law);
    EXPECT_EQ(unlike(whole, stopped), "");
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

} // namespace
} // namespace platen::apps::testing
