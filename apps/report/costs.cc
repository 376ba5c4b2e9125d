#include "apps/report/costs.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace platen::apps::report {
namespace {

double number(const Run &run, const char *key) {
  const auto found = run.summary.find(key);
  return found != run.summary.end() && found->is_number() ? found->get<double>() : 0;
}

// The line of the run's log that names the machine; empty where there is none.
std::string machine_of(const Run &run) {
  const std::string start = "machine ";
  std::ifstream log(run.folder / "run.log");
  for (std::string line; std::getline(log, line);)
    if (line.rfind(start, 0) == 0) return line.substr(start.size());
  return "";
}

} // namespace

std::vector<Cost> costs_of(const Run &run) {
  std::vector<Cost> costs;
  const auto stages = run.summary.find("stage_seconds");
  if (stages == run.summary.end() || !stages->is_object()) return costs;
  double known = 0;
  const auto add = [&](const std::string &name, double seconds, bool is_stage) {
    if (!(seconds > 0)) return;
    costs.push_back({name, seconds, is_stage});
    known += seconds;
  };
  for (const auto &[name, seconds] : stages->items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (seconds.is_number()) add(words, seconds.get<double>(), true);
  }
  add("setting up", number(run, "setup_seconds"), false);
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost &a, const Cost &b) { return a.seconds > b.seconds; });
  add("the rest", number(run, "wall_seconds") - known, false);
  return costs;
}

std::string machine_words(const Run &run) {
  std::string words;
  const auto add = [&words](const std::string &more) { words += (words.empty() ? "" : "; ") + more; };
  char text[64];
  if (const double rate = number(run, "particle_steps_per_second"); rate > 0) {
    std::snprintf(text, sizeof text, "%.2f million sphere steps a second", 1e-6 * rate);
    add(text);
  }
  if (const double threads = number(run, "threads"); threads > 0) {
    std::snprintf(text, sizeof text, threads == 1 ? "%.0f thread" : "%.0f threads", threads);
    add(text);
  }
  if (const std::string machine = machine_of(run); !machine.empty()) add(machine);
  if (const double bytes = number(run, "peak_memory_bytes"); bytes > 0) {
    std::snprintf(text, sizeof text, "%.0f MB at most", 1e-6 * bytes);
    add(text);
  }
  return words;
}

} // namespace platen::apps::report
