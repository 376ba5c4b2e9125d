// The only file of the scene library with deal.II in it: ParameterHandler lays out what it would read itself.
#include <deal.II/base/parameter_handler.h>

#include <ostream>

#include "apps/scene/scene_files.h"

namespace platen::apps {
namespace {

std::vector<std::string> sections_of(const std::string &path) {
  std::vector<std::string> names;
  std::size_t first = 0;
  for (std::size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', first)) {
    names.push_back(path.substr(first, slash - first));
    first = slash + 1;
  }
  return names;
}

} // namespace

void write_prm(const std::vector<Entry> &entries, bool with_documentation, std::ostream &out) {
  dealii::ParameterHandler handler;
  for (const Entry &entry : entries) {
    const std::vector<std::string> sections = sections_of(entry.path);
    for (const std::string &section : sections)
      handler.enter_subsection(section);
    const std::string key = entry.path.substr(entry.path.rfind('/') + 1), about = limits(entry);
    handler.declare_entry(key, entry.default_text, dealii::Patterns::Anything(),
                          entry.documentation + (about.empty() ? "" : " Allowed: " + about + "."));
    handler.set(key, entry.text);
    for (std::size_t k = 0; k < sections.size(); ++k)
      handler.leave_subsection();
  }
  using Style = dealii::ParameterHandler::OutputStyle;
  handler.print_parameters(out,
                           (with_documentation ? Style::PRM : Style::ShortPRM) | Style::KeepDeclarationOrder);
}

} // namespace platen::apps
