#include "apps/run/run_state.h"

namespace platen::apps {
namespace {

// Parts of a checkpoint.
constexpr const char *test_part = "test", *results_part = "results", *marks_part = "files";
constexpr const char *instruction_set_block = "test/specimen/instruction_set";

} // namespace

void save_state(StateSink &to, const coupling::PlatenTest &problem, const Results &results,
                const FileMarks &marks) {
  save_part(to, test_part, problem);
  save_part(to, results_part, results);
  save_part(to, marks_part, marks);
}

dem::InstructionSet resumed_instruction_set(const CheckpointReader &from, RunLog &log) {
  const dem::InstructionSet best = dem::best_instruction_set();
  std::string begun;
  try {
    begun = text_of(from, instruction_set_block);
  } catch (const StateError &e) {
    from.fail(e.what());
  }
  for (const dem::InstructionSet set :
       {dem::InstructionSet::baseline, dem::InstructionSet::avx2, dem::InstructionSet::avx512})
    if (begun == dem::name(set) && set <= best) return set;
  log.warning(
      "began with the instruction set {}, which this machine lacks: goes on with {}, and its last digits are "
      "no longer those of one machine",
      begun, dem::name(best));
  return best;
}

FileMarks load_marks(const CheckpointReader &from) {
  FileMarks marks;
  try {
    LoadingArchive(from).part(marks_part, marks);
  } catch (const StateError &e) {
    from.fail(e.what());
  }
  return marks;
}

FileMarks load_state(const CheckpointReader &from, coupling::PlatenTest &problem, Results &results) {
  FileMarks marks;
  try {
    LoadingArchive archive(from);
    archive.part(test_part, problem);
    archive.part(results_part, results);
    archive.part(marks_part, marks);
    archive.require_all_read();
  } catch (const StateError &e) {
    from.fail(e.what());
  }
  return marks;
}

} // namespace platen::apps
