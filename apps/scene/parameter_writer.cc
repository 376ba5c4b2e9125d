// The only file of the scene library with deal.II in it: ParameterHandler lays out what it would read itself.
#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <ostream>

#include "apps/scene/scene_files.h"

namespace platen::apps {

void write_prm(const std::vector<Entry> &entries, bool with_documentation, std::ostream &out) {
  dealii::ParameterHandler handler;
  for (const Entry &entry : entries) {
    const std::filesystem::path path(entry.path), sections = path.parent_path();
    for (const std::filesystem::path &section : sections)
      handler.enter_subsection(section.string());
    const std::string key = path.filename().string(), about = limits(entry);
    handler.declare_entry(key, entry.default_text, dealii::Patterns::Anything(),
                          entry.documentation + (about.empty() ? "" : " Allowed: " + about + "."));
    handler.set(key, entry.text);
    for (auto section = sections.begin(); section != sections.end(); ++section)
      handler.leave_subsection();
  }
  using Style = dealii::ParameterHandler::OutputStyle;
  handler.print_parameters(out,
                           (with_documentation ? Style::PRM : Style::ShortPRM) | Style::KeepDeclarationOrder);
}

} // namespace platen::apps
