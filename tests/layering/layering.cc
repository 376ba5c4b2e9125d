#include "layering/layering.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace platen::layering {
namespace {

// Paths as they stand between <> or "", matched at their beginning.
const std::map<std::string, std::regex> &forbidden_includes() {
  static const std::string files = R"(fstream|filesystem|stdio\.h|fcntl\.h|experimental/filesystem)";
  static const std::string solvers =
      R"(Epetra|EpetraExt|Teuchos|Tpetra|AztecOO|Amesos|Ifpack|ml_|ML_|Sacado|ROL_|Kokkos|NOX)";
  static const std::string trilinos = solvers + "|Zoltan|zoltan";
  static const std::map<std::string, std::regex> rules = {
      {"base", std::regex("^((\\.\\./)*(dem|dist|fem|coupling|apps)/|deal\\.II/|vtk|mpi\\.h|(" + trilinos +
                          ")|(" + files + ")$)")},
      {"dem", std::regex("^((\\.\\./)*(dist|fem|coupling|apps)/|deal\\.II/|vtk|mpi\\.h|(" + trilinos + ")|(" +
                         files + ")$)")},
      {"dist",
       std::regex("^((\\.\\./)*(fem|coupling|apps)/|deal\\.II/|vtk|(" + solvers + ")|(" + files + ")$)")},
      {"fem", std::regex("^((\\.\\./)*(dem|dist|coupling|apps)/|vtk|(" + files + ")$)")},
      {"coupling", std::regex("^((\\.\\./)*apps/|vtk|(" + files + ")$)")}};
  return rules;
}

// Within a room: laws and contacts are below what uses them.
const std::map<std::string, std::regex> &forbidden_within() {
  static const std::map<std::string, std::regex> rules = {
      {"dem/laws/", std::regex("^dem/(?!laws/)")},
      {"coupling/contact/", std::regex("^coupling/(?!contact/)")},
      {"coupling/program/", std::regex("^coupling/boundaries/")}};
  return rules;
}

bool goes_up_within(const std::string &file, const std::string &path) {
  for (const auto &[folder, forbidden] : forbidden_within())
    if (file.rfind(folder, 0) == 0 && std::regex_search(path, forbidden)) return true;
  return false;
}

// <cstdio> itself may be included for snprintf; what opens a file may not be called. deal.II's parallel
// writers open files of their own, and VTK is not there to be called.
const std::regex &file_opening() {
  static const std::regex words(
      R"(\b(fopen|freopen|fdopen|tmpfile|mkstemp|openat|creat|(i|o)?fstream|basic_(i|o)?fstream|filebuf)\b)"
      R"(|(^|[^\w.>])(::)?open\s*\(|\bwrite_vtu_(in_parallel|with_pvtu_record)\b|\bfilesystem\s*::)");
  return words;
}

// Functions whose code the C library chooses by the processor: base/portable.h has those that give the same
// bits on all. Measures may use them: no step of a run depends on these.
const std::regex &of_processor() {
  static const std::regex words(R"(\bstd::(a?(sin|cos|tan)h?|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow)"
                                R"(|[tl]gamma|erfc?|fma)\s*\()");
  return words;
}

bool is_measure(const std::string &file) {
  return file.rfind("dem/measure/", 0) == 0 || file == "dem/packing/quality.cc" ||
         file == "dem/packing/direction_cells.cc";
}

// Callers of dist/ need MPI alone to compile.
const std::regex &of_partitioner() {
  static const std::regex words("^(Zoltan|zoltan)");
  return words;
}

bool is_header(const std::string &file) {
  return file.size() > 2 && file.compare(file.size() - 2, 2, ".h") == 0;
}

// "Loading/Axial rate": a user of the library has no scene file; messages name members.
const std::regex &scene_entry() {
  static const std::regex words(
      R"(\b(Scene|Specimen|Material|Effects|Bond|Phases|Contact|Platens|Sleeve|Loading|Integration|Output)"
      R"(|Checkpoint|Expect|Study|Calibrate|Pair test|Bar test)/[A-Z][a-z])");
  return words;
}

// Blanks what the pattern finds, except for its first group; keeps line breaks.
std::string blanked(const std::string &text, const std::regex &pattern) {
  std::string code;
  auto from = text.cbegin();
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    code.append(from, (*match)[0].first);
    if ((*match)[1].matched)
      code += match->str(1);
    else
      code.append(static_cast<std::size_t>(std::count((*match)[0].first, (*match)[0].second, '\n')), '\n');
    from = (*match)[0].second;
  }
  return code.append(from, text.cend());
}

} // namespace

std::vector<Violation> check_source(const std::string &folder, const std::string &file,
                                    const std::string &text) {
  static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Violation> violations;
  const auto rule = forbidden_includes().find(folder);
  if (rule == forbidden_includes().end()) return violations;

  static const std::regex comments(R"re(("(?:\\.|[^"\\\n])*")|//[^\n]*|/\*[\s\S]*?\*/)re");
  // Literals too, but for the quotes of includes.
  static const std::regex noise(
      R"re((#\s*include\s*"[^"\n]*")|//[^\n]*|/\*[\s\S]*?\*/|"(?:\\.|[^"\\\n])*")re");
  std::istringstream lines(blanked(text, noise)), literals(blanked(text, comments));
  std::string line, literal;
  std::smatch match;
  for (int number = 1; std::getline(lines, line) && std::getline(literals, literal); ++number) {
    if (std::regex_search(line, match, include)) {
      const std::string path = match[1];
      if (std::regex_search(path, rule->second) || goes_up_within(file, path))
        violations.push_back({file, number, folder + "/ must not include " + path});
      else if (folder == "dist" && is_header(file) && std::regex_search(path, of_partitioner()))
        violations.push_back({file, number, "a header of dist/ must not include " + path});
    } else if (std::regex_search(line, match, file_opening())) {
      violations.push_back({file, number, folder + "/ must not open files: " + line});
    }
    if (!is_measure(file) && std::regex_search(line, match, of_processor()))
      violations.push_back({file, number, match.str() + ") differs by processor: base/portable.h"});
    if (std::regex_search(literal, match, scene_entry()))
      violations.push_back({file, number, folder + "/ must not name an entry of a scene: " + match.str()});
  }
  return violations;
}

Survey check_tree(const std::filesystem::path &root) {
  Survey survey;
  for (const auto &[folder, rule] : forbidden_includes()) {
    std::vector<std::filesystem::path> sources;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cc")
        sources.push_back(entry.path());
    std::sort(sources.begin(), sources.end());
    for (const auto &path : sources) {
      std::ifstream stream(path);
      std::ostringstream text;
      text << stream.rdbuf();
      if (!stream) throw std::runtime_error("cannot read " + path.string());
      const auto found = check_source(folder, path.lexically_relative(root).string(), text.str());
      survey.violations.insert(survey.violations.end(), found.begin(), found.end());
      ++survey.files;
    }
  }
  return survey;
}

} // namespace platen::layering
