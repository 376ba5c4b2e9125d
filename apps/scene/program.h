// What the programs that read scenes have in common, and what tells them apart. The programs themselves are
// listed in apps/programs.cc.
#pragma once

#include <string>
#include <vector>

namespace platen::apps {

class Parameters;
class SceneCheck;
struct Scene;

// What a program presses between platens. Entries that ask for more are refused.
enum class Presses {
  nothing,
  trials,   // many short tests of a calibration
  discs,    // laid on their rims
  specimens // whole tests, with all that a scene may ask
};

struct Program {
  std::string name;    // "platen-compress"
  std::string purpose; // one sentence for --help
  Presses presses = Presses::nothing;
  bool packs = true;                   // its specimen is packed or read from a file
  bool bonds = true;                   // its spheres are bonded
  std::vector<std::string> kinds = {}; // words, one of which comes first on the line; empty: no such argument
  bool shares_packings = false;        // has --packings
  bool caches_packings = false;        // has --no-cache
  bool plans_runs = false;             // has --plan, --run, --collect
  bool on_ranks = false;               // mpirun may start it several times for one run

  // Sections and entries that it reads, and those of them that it does not; the longest path decides.
  std::vector<std::string> reads = {}, but = {};

  // Its own sections, which no other program declares. Null: it has none.
  std::string section = "";                          // "Study", with all that is in it
  void (*declare)(Parameters &, Scene &) = nullptr;  // binds them to scene.own
  void (*complete)(Parameters &, Scene &) = nullptr; // fills what one entry takes from another
  void (*check)(const SceneCheck &) = nullptr;       // refuses what its sections make impossible
  // Whether it gives each of its runs this entry of the scene itself, so that the scene need not.
  bool (*gives)(const Scene &, const Parameters &, const std::string &path) = nullptr;
  // Whether one of its tests needs a part ("Sleeve") that the scene itself does not ask for.
  bool (*uses)(const Scene &, const std::string &part) = nullptr;
  // Sections of the other programs: their keys are passed over.
  std::vector<std::string> foreign = {};

  bool reads_entry(const std::string &path) const;
  bool presses_specimens() const { return presses == Presses::specimens; }
};

} // namespace platen::apps
