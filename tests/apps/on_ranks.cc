#include "apps/on_ranks.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <stdexcept>

#include "apps/output/checkpoint_folder.h"

namespace platen::apps::testing {
namespace {

const char *const of_time = "files/wall_seconds"; // the one block that tells it

std::map<std::string, std::string> blocks_in(const fs::path &checkpoint) {
  const CheckpointReader reader(checkpoint);
  std::map<std::string, std::string> blocks;
  for (const std::string &name : reader.names()) {
    if (name == of_time) continue;
    const StoredBlock stored = *reader.find(name);
    std::string bytes(stored.rows * stored.type.numbers * stored.type.bytes, '\0');
    reader.read(name, bytes.data());
    blocks[checkpoint.filename().string() + ": " + name] = bytes;
  }
  return blocks;
}

std::set<fs::path> checkpoints_of(const fs::path &run) {
  return {fs::directory_iterator(run / "checkpoint"), fs::directory_iterator()};
}

std::map<std::string, std::string> checkpoints_in(const fs::path &run) {
  std::map<std::string, std::string> all;
  for (const fs::path &file : checkpoints_of(run))
    all.merge(blocks_in(file));
  return all;
}

} // namespace

OnRanks::OnRanks() {
  std::istringstream words(PLATEN_MPI_ENVIRONMENT);
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    setenv(word.substr(0, equals).c_str(), word.substr(equals + 1).c_str(), 1);
  }
}

std::vector<std::string> OnRanks::on(int ranks, const std::vector<std::string> &program, bool delayed) {
  std::vector<std::string> command{PLATEN_MPIEXEC, "-n", std::to_string(ranks)};
  const std::string wrapper = PLATEN_MPI_DELAY; // empty where sanitizers have to be loaded first
  if (delayed && !wrapper.empty())
    command.insert(command.end(),
                   {"/usr/bin/env", "LD_PRELOAD=" + wrapper, "PLATEN_DELAY_US=300", "PLATEN_DELAY_SEED=5"});
  command.insert(command.end(), program.begin(), program.end());
  return command;
}

std::vector<std::string> OnRanks::crush(const std::string &name, const std::vector<std::string> &more) {
  std::vector<std::string> words{test_scene("crushed.prm"), "-o", name, "--quiet"};
  for (const char *entry :
       {"Loading/Axial rate = 2 m/s", "Loading/Target strain = 0.004", "Loading/Stop at residual = 0",
        "Output/Every = 8", "Output/Fields every = 160", "Checkpoint/Every = 100"})
    words.insert(words.end(), {"-s", entry});
  words.insert(words.end(), more.begin(), more.end());
  if (std::find(more.begin(), more.end(), "-t") == more.end()) words.insert(words.end(), {"-t", "1"});
  return compress_command(words);
}

fs::path OnRanks::whole(const std::vector<std::string> &more) const {
  static std::map<std::vector<std::string>, fs::path> made;
  if (const auto found = made.find(more); found != made.end()) return found->second;
  const std::string name = std::to_string(made.size());
  const Outcome outcome = run_program(crush(name, more), process_folder());
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  return made[more] = process_folder() / name;
}

void OnRanks::run_on(int ranks, const std::string &name, const std::vector<std::string> &more,
                     bool delayed) const {
  const Outcome outcome = run(on(ranks, crush(name, more), delayed));
  ASSERT_EQ(outcome.status, 0) << ranks << " ranks: " << outcome.error;
}

long OnRanks::rows_in(const std::string &name) const {
  return lines_in(folder_ / name / "history.csv");
}

std::string OnRanks::said() const {
  return content_of(folder_ / "error.txt");
}

std::string OnRanks::unlike(const fs::path &one, const std::string &other) const {
  return difference(results_in(folder_ / one), results_in(folder_ / other)) +
         difference(checkpoints_in(folder_ / one), checkpoints_in(folder_ / other));
}

std::string OnRanks::unlike_at_end(const fs::path &one, const std::string &other) const {
  std::string all = difference(results_in(folder_ / one), results_in(folder_ / other));
  const std::set<fs::path> files = checkpoints_of(folder_ / one);
  for (const fs::path &file : files)
    if (const fs::path twin = folder_ / other / "checkpoint" / file.filename();
        file == *files.rbegin() || fs::exists(twin))
      all += difference(blocks_in(file), blocks_in(twin));
  return all;
}

pid_t process_of_rank(pid_t mpirun, int rank) {
  const std::string process = "/proc/" + std::to_string(mpirun);
  std::ifstream children(process + "/task/" + std::to_string(mpirun) + "/children");
  const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank) + '\0';
  for (pid_t id = 0; children >> id;) {
    std::ifstream environment("/proc/" + std::to_string(id) + "/environ", std::ios::binary);
    if (contains(std::string(std::istreambuf_iterator<char>(environment), {}), wanted)) return id;
  }
  throw std::runtime_error("no rank " + std::to_string(rank) + " below process " + std::to_string(mpirun));
}

long count_of(const std::string &text, const std::string &part) {
  long count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

} // namespace platen::apps::testing
