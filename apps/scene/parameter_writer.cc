// Scenes as text, laid out as deal.II's ParameterHandler lays them out, which reads them: a program of
// hundreds of libraries would be loaded for a page of text otherwise.
#include <algorithm>
#include <iterator>
#include <memory>
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
  std::vector<std::unique_ptr<Node>> sections;
  Node &section(const std::string &called) {
    for (const auto &known : sections)
      if (known->name == called) return *known;
    sections.push_back(std::make_unique<Node>());
    sections.back()->name = called;
    return *sections.back();
  }
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
      node = &node->section(entry.path.substr(begin, end - begin));
      begin = end + 1;
    }
    node->entries.push_back(&entry);
  }
  return root;
}

// Lines of at most `width` characters, but for longer words.
std::vector<std::string> lines_of(const std::string &text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;)
    if (lines.empty() || lines.back().size() + 1 + word.size() > width)
      lines.push_back(word);
    else
      lines.back() += ' ' + word;
  return lines;
}

class PrmWriter {
public:
  PrmWriter(bool documented, std::ostream &out) : documented_(documented), out_(out) {}

  void write(const Node &node, std::size_t depth) {
    const std::string indent(2 * depth, ' ');
    std::size_t longest_key = 0, longest_value = 0;
    for (const Entry *entry : node.entries) {
      longest_key = std::max(longest_key, key_of(*entry).size());
      longest_value = std::max(longest_value, entry->text.size());
    }
    for (const Entry *entry : node.entries) {
      if (documented_) write_documentation(*entry, indent, entry == node.entries.front());
      const std::string key = key_of(*entry);
      out_ << indent << "set " << key << std::string(longest_key - key.size(), ' ') << " = " << entry->text;
      if (documented_ && entry->text != entry->default_text)
        out_ << std::string(longest_value - entry->text.size(), ' ') << " # default: " << entry->default_text;
      out_ << '\n';
    }
    if (!node.entries.empty() && !node.sections.empty()) out_ << (documented_ ? "\n\n" : "\n");
    for (const auto &section : node.sections) {
      out_ << indent << "subsection " << section->name << '\n';
      write(*section, depth + 1);
      out_ << indent << "end\n";
      if (documented_) out_ << '\n';
      if (documented_ && depth == 0) out_ << '\n';
    }
  }

private:
  void write_documentation(const Entry &entry, const std::string &indent, bool is_first) {
    const std::string about = limits(entry);
    const std::string text = entry.documentation + (about.empty() ? "" : " Allowed: " + about + ".");
    if (text.empty()) return;
    if (!is_first) out_ << '\n';
    for (const std::string &line : lines_of(text, page - indent.size() - 2))
      out_ << indent << "# " << line << '\n';
  }

  bool documented_;
  std::ostream &out_;
};

} // namespace

void write_prm(const std::vector<Entry> &entries, bool with_documentation, std::ostream &out) {
  if (with_documentation) out << "# Listing of Parameters\n# ---------------------\n";
  PrmWriter(with_documentation, out).write(tree_of(entries), 0);
}

} // namespace platen::apps
