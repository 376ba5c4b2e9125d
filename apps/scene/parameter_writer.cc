// Scenes as text: laid out as deal.II's ParameterHandler lays them out, which reads them too (a program of
// hundreds of libraries would be loaded for a page of text otherwise), or as JSON.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "apps/scene/scene_files.h"

namespace platen::apps {
namespace {

constexpr std::size_t page = 78; // columns

// A section with what stands in it, each in the order of declaration.
struct Node {
  std::string name;
  std::vector<const Entry *> entries;
  std::vector<Node> sections;
};

std::string key_of(const Entry &entry) {
  return entry.path.substr(entry.path.rfind('/') + 1);
}

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
    longest_key = std::max(longest_key, key_of(*entry).size());
    longest_value = std::max(longest_value, entry->text.size());
  }
  for (const Entry *entry : node.entries) {
    const std::string key = key_of(*entry);
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

} // namespace platen::apps
