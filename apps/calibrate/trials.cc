#include "apps/calibrate/trials.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <mutex>
#include <numeric>
#include <sstream>

#include "apps/calibrate/calibrate_section.h"
#include "apps/output/file.h"
#include "apps/output/numbers.h"
#include "apps/output/sha256.h"
#include "apps/output/specimen_csv.h"
#include "apps/output/stop_signal.h"
#include "apps/run/packing_cache.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "apps/scene/units.h"
#include "base/parallel.h"

namespace platen::apps {
namespace {

constexpr const char *head = "test,seed,", *tail =
                                               "status,youngs_modulus_gauge_pa,youngs_modulus_platen_pa,"
                                               "poisson_ratio,strength_pa,strain_at_peak,curve_pa,checksum";
constexpr std::size_t first_number = 2, status_at = first_number + knob_count, results_at = status_at + 1,
                      curve_at = results_at + 5;
constexpr const char *packing_sums_name = "packings.sha256";
constexpr std::size_t sum_digits = 16; // of the SHA-256 of a row before its last comma

std::vector<std::string> columns() {
  std::string all = head;
  for (const KnobFacts &knob : knob_facts())
    all += std::string(knob.column) + ",";
  return cells_of(all + tail);
}

// What decides the result; elastic trials do not ask for strengths.
Choice deciding(const Trial &t) {
  Choice c = t.choice;
  for (const KnobFacts &knob : knob_facts())
    if (!t.test.loads() && !knob.elastic) c[knob.knob] = 0;
  return c;
}

std::string key_of(const Trial &t) {
  std::string key = t.test.name() + "," + std::to_string(t.seed);
  for (const double number : deciding(t).numbers)
    key += "," + shortest_text(number);
  return key;
}

std::string sum_of_row(std::string_view line) {
  return sha256_of(line.substr(0, line.rfind(','))).substr(0, sum_digits);
}

// Stresses of a curve in one cell, blanks between them.
std::string text_of_curve(const std::vector<double> &curve) {
  std::string text;
  for (const double stress : curve)
    text += (text.empty() ? "" : " ") + shortest_text(stress);
  return text.empty() ? "-" : text;
}

std::vector<double> curve_of_text(const std::string &text) {
  std::vector<double> curve;
  std::istringstream numbers(text);
  for (std::string number; numbers >> number;)
    if (const auto stress = number_of(number)) curve.push_back(*stress);
  return curve;
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
  std::vector<unsigned long> seeds(static_cast<std::size_t>(calibrate_of(scene).seeds));
  std::iota(seeds.begin(), seeds.end(), scene.general.seed);
  return seeds;
}

std::vector<unsigned long> unseen_seeds(const Scene &scene, std::size_t round) {
  std::vector<unsigned long> seeds(static_cast<std::size_t>(calibrate_of(scene).verification_seeds));
  std::iota(
      seeds.begin(), seeds.end(),
      scene.general.seed + static_cast<unsigned long>(calibrate_of(scene).seeds) + round * seeds.size());
  return seeds;
}

Trials::Trials(const Scene &scene, const OutputPaths &paths, bool resume, RunLog &log)
    : scene_(scene), paths_(paths), log_(log) {
  if (resume)
    read_packing_sums(), read();
  else
    table_.emplace(paths_.folder / "trials.csv", columns());
}

void Trials::read() {
  const std::filesystem::path path = paths_.folder / "trials.csv";
  std::ifstream file = open_file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t end = text.rfind('\n'); // a row that was cut off counts for nothing
  if (!file || end == std::string::npos)
    throw InputError(path.string() + ": error: holds no trials to resume from; leave out --resume");
  std::istringstream lines(text.substr(0, end + 1));
  std::string line;
  std::getline(lines, line);
  if (cells_of(line) != columns())
    throw InputError(path.string() + ":1: error: has other columns than this version writes");
  std::string whole = line + '\n';
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    std::vector<double> values;
    for (std::size_t k = results_at; k < std::min(curve_at, cells.size()); ++k)
      if (const auto value = cells[k].empty() ? not_given : number_of(cells[k])) values.push_back(*value);
    if (cells.size() != columns().size() || values.size() != curve_at - results_at ||
        cells.back() != sum_of_row(line)) {
      log_.warning("{}:{}: has been changed since it was written: its trial is made again", path.string(),
                   number);
      continue;
    }
    whole += line + '\n';
    std::string key = cells[0] + "," + cells[1];
    for (std::size_t k = first_number; k < status_at; ++k)
      key += "," + shortest_text(number_of(cells[k]).value_or(not_given));
    known_[key] = {cells[status_at],
                   values[0],
                   values[1],
                   values[2],
                   values[3],
                   values[4],
                   curve_of_text(cells[curve_at])};
  }
  if (whole.size() < end + 1) write_text_aside(path, whole);
  table_.emplace(path, columns(), whole.size());
}

void Trials::keep(const Trial &t, const TrialResult &r) {
  const std::string name = t.test.name(), status = one_cell(r.status), curve = text_of_curve(r.curve);
  std::vector<CsvCell> cells{name, t.seed};
  for (const double number : deciding(t).numbers)
    cells.emplace_back(number);
  cells.insert(cells.end(), {status, r.young_modulus, r.platen_modulus, r.poisson_ratio, r.strength,
                             r.strain_at_peak, curve});
  std::string line;
  for (const CsvCell &cell : cells) {
    cell.append_to(line);
    line += ',';
  }
  const std::string sum = sum_of_row(line);
  cells.emplace_back(sum);
  table_->row(cells);
  known_[key_of(t)] = r;
  ++made_;
}

const dem::Specimen &Trials::packing(unsigned long seed) {
  pack({{SpecimenTest{}, seed, Choice{}}});
  return packings_.at({"", seed});
}

void Trials::pack(const std::vector<Trial> &trials) {
  std::vector<Trial> missing;
  for (const Trial &t : trials)
    if (packings_.count(packing_of(t)) == 0 &&
        std::none_of(missing.begin(), missing.end(),
                     [&](const Trial &m) { return packing_of(m) == packing_of(t); }))
      missing.push_back(t);
  std::vector<dem::Specimen> made(missing.size());
  std::vector<char> changed(missing.size(), 0);
  const auto name_of = [](const Trial &t) {
    const std::string form = t.test.form();
    return (form.empty() ? "" : form + "_") + std::to_string(t.seed);
  };
  in_order(missing.size(), [&](std::size_t k) {
    const std::filesystem::path file = paths_.folder / ("packing_" + name_of(missing[k]) + ".csv");
    if (const auto sum = packing_sums_.find(file.filename().string()); sum != packing_sums_.end()) {
      if (sha256_of_file(file) == sum->second) {
        made[k] = read_specimen_csv(file).specimen;
        return;
      }
      changed[k] = 1;
    }
    Scene scene = scene_of_form(scene_, missing[k].test);
    scene.general.seed = missing[k].seed;
    RunLog silent(Loudness::quiet); // several threads are here; what is wrong with a packing is made good
    const bool as_read = missing[k].test.form().empty();
    made[k] = make_bonded_specimen(scene, as_read ? keep_in_cache(scene, true, silent) : KeepPacking());
    write_specimen_csv(file, made[k]);
  });
  for (std::size_t k = 0; k < missing.size(); ++k) {
    const std::string form = missing[k].test.form(), name = "packing_" + name_of(missing[k]) + ".csv";
    if (changed[k] != 0)
      log_.warning("{}: is not as it was written: packed again", (paths_.folder / name).string());
    packing_sums_[name] = sha256_of_file(paths_.folder / name).value_or("");
    log_.info("packing of seed {}{}: {} spheres", missing[k].seed, form.empty() ? "" : " (" + form + ")",
              made[k].size());
    packings_[packing_of(missing[k])] = std::move(made[k]);
  }
  if (!missing.empty()) write_packing_sums();
}

// As sha256sum has them, which can verify them: `sha256sum -c packings.sha256`.
void Trials::write_packing_sums() const {
  std::string text;
  for (const auto &[name, sum] : packing_sums_)
    text += sum + "  " + name + '\n';
  write_text_aside(paths_.folder / packing_sums_name, text);
}

void Trials::read_packing_sums() {
  std::ifstream file = open_file(paths_.folder / packing_sums_name);
  std::string sum, name;
  while (file >> sum >> name)
    packing_sums_[name] = sum;
}

TrialResult Trials::run(const Trial &t) const {
  return run_test(scene_, packings_.at(packing_of(t)), t.choice, t.test);
}

std::vector<TrialResult> Trials::operator()(const std::vector<Trial> &trials) {
  std::vector<Trial> open;
  for (const Trial &t : trials) {
    const std::string key = key_of(t);
    if (known_.count(key) > 0 ||
        std::any_of(open.begin(), open.end(), [&](const Trial &o) { return key_of(o) == key; }))
      continue;
    open.push_back(t);
  }
  pack(open);
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
