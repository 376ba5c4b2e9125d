// Scenes as text: laid out as deal.II's ParameterHandler lays them out, which reads them too (a program of
// hundreds of libraries would be loaded for a page of text otherwise), or as JSON.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "apps/scene/scene_writer.h"

#include "apps/scene/program.h"
#include "apps/scene/scene.h"
#include "apps/scene/units.h"

namespace platen::apps {
namespace {

constexpr std::size_t page = 78; // columns

// A section with what stands in it, each in the order of declaration.
struct Node {
  std::string name;
  std::vector<const Entry *> entries;
  std::vector<Node> sections;
};

Node tree_of(const std::vector<Entry> &entries) {
  Node root;
  for (const Entry &entry : entries) {
    Node *node = &root;
    std::size_t begin = 0;
    for (auto end = entry.path.find('/'); end != std::string::npos; end = entry.path.find('/', begin)) {
      const std::string name = entry.path.substr(begin, end - begin);
      auto known = std::find_if(node->sections.begin(), node->sections.end(),
                                [&](const Node &one) { return one.name == name; });
      if (known == node->sections.end()) known = node->sections.insert(known, Node{name, {}, {}});
      node = &*known;
      begin = end + 1;
    }
    node->entries.push_back(&entry);
  }
  return root;
}

void write_documentation(const Entry &entry, const std::string &indent, std::ostream &out) {
  const std::string about = limits(entry);
  std::istringstream words(entry.documentation + (about.empty() ? "" : " Allowed: " + about + "."));
  std::string line;
  for (std::string word; words >> word; line += (line.empty() ? "" : " ") + word)
    if (!line.empty() && line.size() + 1 + word.size() > page - indent.size() - 2) {
      out << indent << "# " << line << '\n';
      line.clear();
    }
  if (!line.empty()) out << indent << "# " << line << '\n';
}

void write(const Node &node, std::size_t depth, bool documented, std::ostream &out) {
  const std::string indent(2 * depth, ' ');
  std::size_t longest_key = 0, longest_value = 0;
  for (const Entry *entry : node.entries) {
    longest_key = std::max(longest_key, last_name(entry->path).size());
    longest_value = std::max(longest_value, entry->text.size());
  }
  for (const Entry *entry : node.entries) {
    const std::string key = last_name(entry->path);
    if (documented && entry != node.entries.front()) out << '\n';
    if (documented) write_documentation(*entry, indent, out);
    out << indent << "set " << key << std::string(longest_key - key.size(), ' ') << " = " << entry->text;
    if (documented && entry->changed())
      out << std::string(longest_value - entry->text.size(), ' ') << " # default: " << entry->default_text;
    out << '\n';
  }
  if (!node.entries.empty() && !node.sections.empty()) out << (documented ? "\n\n" : "\n");
  for (const Node &section : node.sections) {
    out << indent << "subsection " << section.name << '\n';
    write(section, depth + 1, documented, out);
    out << indent << (documented ? depth == 0 ? "end\n\n\n" : "end\n\n" : "end\n");
  }
}

// Of sections alike what is set; documented the first one whole.
std::vector<Entry> written(const Parameters &parameters, bool documented) {
  std::vector<Entry> entries;
  for (const Entry &entry : parameters.entries())
    if (entry.number == 0 || entry.changed() || (entry.number == 1 && documented)) entries.push_back(entry);
  return entries;
}

// The nearest section or entry of any section; "" where none is near.
std::string nearest_part(const Parameters &parameters, const std::string &part) {
  std::vector<std::string> names = parameters.sections();
  for (const Entry &entry : parameters.entries())
    names.push_back(entry.path);
  const std::string nearest = nearest_word(part, names);
  if (!nearest.empty()) return nearest;
  const std::string key = last_name(part);
  for (const std::string &name : names) // the right name in another place, or in none
    if (edit_distance(last_name(name), key) <= 1) return name;
  return "";
}

// A section, with what is in it, or one entry.
std::vector<Entry> part_of(const Parameters &parameters, const std::string &part) {
  std::vector<Entry> entries = parameters.unwritten(part);
  for (const Entry &entry : parameters.entries()) {
    const bool inside = entry.path.rfind(part + "/", 0) == 0, itself = section_of(entry.path) == part;
    const bool told = entry.changed() || entry.number <= 1 || itself;
    if (entry.path == part || (inside && told)) entries.push_back(entry);
  }
  if (!entries.empty()) return entries;
  const std::string nearest = nearest_part(parameters, part);
  throw InputError("command line: error: --print-parameters " + part + ": no such section or entry." +
                   (nearest.empty()
                        ? " Allowed: SECTION or SECTION/KEY, as --print-parameters alone tells them."
                        : " Did you mean \"" + nearest + "\"?"));
}

} // namespace

void write_prm(const std::vector<Entry> &entries, bool with_documentation, std::ostream &out) {
  if (with_documentation) out << "# Listing of Parameters\n# ---------------------\n";
  write(tree_of(entries), 0, with_documentation, out);
}

void write_json(const std::vector<Entry> &entries, std::ostream &out) {
  nlohmann::ordered_json tree;
  for (const Entry &entry : entries)
    tree[nlohmann::ordered_json::json_pointer("/" + entry.path)] = {{"value", entry.text},
                                                                    {"default_value", entry.default_text},
                                                                    {"unit", entry.unit},
                                                                    {"allowed", entry.allowed},
                                                                    {"documentation", entry.documentation}};
  // Text that is no UTF-8 (a title, a path) is shown with replacement characters rather than refused.
  out << tree.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

std::string scene_text(const Scene &scene, const std::filesystem::path &folder) {
  std::vector<Entry> entries = written(*scene.parameters, false);
  for (Entry &entry : entries) {
    if (!entry.is_file || entry.text.empty()) continue;
    const std::filesystem::path from = std::filesystem::absolute(resolved_path(entry));
    std::error_code failure;
    const std::filesystem::path there =
        std::filesystem::relative(from, std::filesystem::absolute(folder), failure);
    entry.text = failure || there.empty() ? from.string() : there.string();
    try {
      check_characters(entry.text);
    } catch (const ValueError &error) {
      throw InputError("error: " + entry.path + " = " + entry.text + " cannot be written to a scene: it " +
                       error.what() + ".");
    }
  }
  std::ostringstream text;
  write_prm(entries, false, text);
  return text.str();
}

void print_parameters(const Scene &scene, const std::string &part, bool as_json, std::ostream &out) {
  std::vector<Entry> read;
  if (!scene.parameters->is_foreign(part))
    for (const Entry &entry :
         part.empty() ? written(*scene.parameters, true) : part_of(*scene.parameters, part))
      if (scene.program->reads_entry(entry.path)) read.push_back(entry);
  if (read.empty())
    throw InputError("command line: error: --print-parameters: " + scene.program->name +
                     " reads nothing of " + part + ".");
  if (as_json)
    write_json(read, out);
  else
    write_prm(read, true, out);
}

} // namespace platen::apps
