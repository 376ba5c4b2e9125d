#include "apps/run/run_state.h"

#include <optional>
#include <string>

#include "base/shortest_text.h"

namespace platen::apps {
namespace {

// Parts of a checkpoint.
constexpr const char *test_part = "test", *results_part = "results", *marks_part = "files";
constexpr const char *instruction_set_block = "test/specimen/instruction_set";

// Places at the peak are those of all spheres, openings those of all bonds, or not kept yet; stages are those
// that the test has.
void require_fitting_results(const StateSource &from, const coupling::PlatenTest &problem) {
  const std::string stages = "results/samples/stage";
  const std::size_t spheres = problem.model.particles.size(),
                    bonds = problem.model.bonds ? problem.model.bonds->initial_count() : 0;
  for (const auto &[name, rows] : {std::pair("results/state_at_peak/position", spheres),
                                   std::pair("results/largest_openings/opening", bonds),
                                   std::pair("results/largest_openings/slip", bonds)})
    if (const std::optional<StoredBlock> block = from.find(name);
        block && block->rows != 0 && block->rows != rows)
      throw StateError(std::string("\"") + name + "\" has " + std::to_string(block->rows) + " rows, 0 or " +
                       std::to_string(rows) + " are needed");
  if (problem.settings().loading.stages.empty() || !from.find(stages)) return;
  const std::vector<double> numbers = rows_of<double>(from, stages);
  const std::size_t count = problem.program().stage_count();
  for (std::size_t row = 0; row < numbers.size(); ++row)
    if (!between(1, static_cast<double>(count)).holds(numbers[row]))
      refuse_row(stages, row, shortest_text(numbers[row]), "1 ... " + std::to_string(count));
}

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
    read_part(from, marks_part, marks);
  } catch (const StateError &e) {
    from.fail(e.what());
  }
  return marks;
}

FileMarks load_state(const CheckpointReader &from, coupling::PlatenTest &problem, Results &results) {
  FileMarks marks;
  try {
    read_parts(
        from,
        [&](Archive &archive) {
          archive.part(test_part, problem);
          archive.part(results_part, results);
          archive.part(marks_part, marks);
        },
        [&] { require_fitting_results(from, problem); });
  } catch (const StateError &e) {
    from.fail(e.what());
  }
  return marks;
}

} // namespace platen::apps
