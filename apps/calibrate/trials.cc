#include "apps/calibrate/trials.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <iterator>
#include <mutex>
#include <numeric>
#include <sstream>

#include "apps/io/numbers.h"
#include "apps/io/specimen_csv.h"
#include "apps/io/stop_signal.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/errors.h"
#include "apps/scene/units.h"
#include "base/parallel.h"

namespace platen::apps {
namespace {

constexpr const char *columns =
    "test,seed,bond_modulus_pa,stiffness_ratio,radius_multiplier,bond_poisson,tensile_pa,shear_pa,"
    "moment_contribution,friction_angle_rad,status,youngs_modulus_gauge_pa,youngs_modulus_platen_pa,"
    "poisson_ratio,strength_pa,strain_at_peak";

// What decides the result; elastic trials do not ask for strengths.
std::array<double, 8> numbers_of(const Trial &t) {
  const BondChoice &c = t.choice;
  if (t.kind == TrialKind::elastic)
    return {c.modulus, c.stiffness_ratio, c.radius_multiplier, c.poisson_ratio, 0, 0, 0, 0};
  return {c.modulus,          c.stiffness_ratio, c.radius_multiplier,   c.poisson_ratio,
          c.tensile_strength, c.shear_strength,  c.moment_contribution, c.friction_angle};
}

std::string key_of(const Trial &t) {
  std::string key = std::string(word(t.kind)) + "," + std::to_string(t.seed);
  for (const double number : numbers_of(t))
    key += "," + shortest_text(number);
  return key;
}

// Without what would break a row in two.
std::string one_cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\n' || c == '"'; }, ';');
  return text;
}

// work(k) for k of [0, count), begun in this order, a thread for each: one thread is worth most to a whole
// trial. A single one may have them all for its loops. After one that throws no other begins.
template <class Work>
void in_order(std::size_t count, const Work &work) {
  std::atomic<std::size_t> next{0};
  const auto part = [&](std::size_t) {
    const std::size_t k = next++;
    if (k >= count) return;
    try {
      work(k);
    } catch (...) {
      next = count;
      throw;
    }
  };
  run_loops(loop_of(count, part));
}

} // namespace

std::vector<unsigned long> training_seeds(const Scene &scene) {
  std::vector<unsigned long> seeds(static_cast<std::size_t>(scene.calibrate.seeds));
  std::iota(seeds.begin(), seeds.end(), scene.general.seed);
  return seeds;
}

std::vector<unsigned long> unseen_seeds(const Scene &scene) {
  std::vector<unsigned long> seeds(static_cast<std::size_t>(scene.calibrate.verification_seeds));
  std::iota(seeds.begin(), seeds.end(),
            scene.general.seed + static_cast<unsigned long>(scene.calibrate.seeds));
  return seeds;
}

Trials::Trials(const Scene &scene, const OutputPaths &paths, bool resume, RunLog &log)
    : scene_(scene), paths_(paths), log_(log) {
  if (resume)
    read();
  else
    table_.emplace(paths_.folder / "trials.csv", cells_of(columns));
}

void Trials::read() {
  const std::filesystem::path path = paths_.folder / "trials.csv";
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t end = text.rfind('\n'); // a row that was cut off counts for nothing
  if (!file || end == std::string::npos)
    throw InputError(path.string() + ": error: holds no trials to resume from; leave out --resume");
  std::istringstream lines(text.substr(0, end + 1));
  std::string line;
  std::getline(lines, line);
  if (line != columns)
    throw InputError(path.string() + ":1: error: has other columns than this version writes");
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    std::vector<double> values;
    for (std::size_t k = 11; k < cells.size(); ++k)
      if (const auto value = number_of(cells[k])) values.push_back(*value);
    if (cells.size() != cells_of(columns).size() || values.size() != 5)
      throw InputError(path.string() + ":" + std::to_string(number) + ": error: is no row of this table");
    std::string key = cells[0] + "," + cells[1];
    for (std::size_t k = 2; k < 10; ++k)
      key += "," + shortest_text(number_of(cells[k]).value_or(not_given));
    known_[key] = {cells[10], values[0], values[1], values[2], values[3], values[4]};
  }
  table_.emplace(path, cells_of(columns), end + 1);
}

void Trials::keep(const Trial &t, const TrialResult &r) {
  const std::string status = one_cell(r.status);
  std::vector<CsvCell> cells{word(t.kind), t.seed};
  for (const double number : numbers_of(t))
    cells.emplace_back(number);
  cells.insert(cells.end(),
               {status, r.young_modulus, r.platen_modulus, r.poisson_ratio, r.strength, r.strain_at_peak});
  table_->row(cells);
  known_[key_of(t)] = r;
  ++made_;
}

const dem::Specimen &Trials::packing(unsigned long seed) {
  pack({seed});
  return packings_.at(seed);
}

void Trials::pack(const std::vector<unsigned long> &seeds) {
  std::vector<unsigned long> missing;
  for (const unsigned long seed : seeds)
    if (packings_.count(seed) == 0 && std::find(missing.begin(), missing.end(), seed) == missing.end())
      missing.push_back(seed);
  std::vector<dem::Specimen> made(missing.size());
  const auto file_of = [&](unsigned long seed) {
    return paths_.folder / ("packing_" + std::to_string(seed) + ".csv");
  };
  in_order(missing.size(), [&](std::size_t k) {
    std::error_code ignored;
    if (std::filesystem::exists(file_of(missing[k]), ignored)) {
      made[k] = read_specimen_csv(file_of(missing[k])).specimen;
      return;
    }
    Scene scene = scene_;
    scene.general.seed = missing[k];
    made[k] = make_specimen(scene);
    write_specimen_csv(file_of(missing[k]), made[k]);
  });
  for (std::size_t k = 0; k < missing.size(); ++k) {
    log_.info("packing of seed {}: {} spheres", missing[k], made[k].size());
    packings_[missing[k]] = std::move(made[k]);
  }
}

TrialResult Trials::run(const Trial &t) const {
  const dem::Specimen &specimen = packings_.at(t.seed);
  if (t.kind == TrialKind::elastic) return elastic_trial(scene_, specimen, t.choice);
  return strength_trial(scene_, specimen, t.choice, t.kind);
}

std::vector<TrialResult> Trials::operator()(const std::vector<Trial> &trials) {
  std::vector<Trial> open;
  std::vector<unsigned long> seeds;
  for (const Trial &t : trials) {
    const std::string key = key_of(t);
    if (known_.count(key) > 0 ||
        std::any_of(open.begin(), open.end(), [&](const Trial &o) { return key_of(o) == key; }))
      continue;
    open.push_back(t);
    seeds.push_back(t.seed);
  }
  pack(seeds);
  std::vector<std::optional<TrialResult>> results(open.size());
  std::mutex mutex;
  std::size_t written = 0;
  in_order(open.size(), [&](std::size_t k) {
    if (stop_requested() != 0) return;
    TrialResult result = run(open[k]);
    const std::lock_guard<std::mutex> lock(mutex);
    results[k] = std::move(result);
    for (; written < open.size() && results[written]; ++written)
      keep(open[written], *results[written]);
  });
  if (stop_requested() != 0) throw Stopped{stop_requested()};
  std::vector<TrialResult> all;
  for (const Trial &t : trials) {
    all.push_back(known_.at(key_of(t)));
    if (!all.back().good()) ++failed_;
  }
  return all;
}

} // namespace platen::apps
