#include "apps/run/member_names.h"

#include <map>

#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"

namespace platen::apps {

std::string entry_of_member(const std::string &member) {
  static const std::map<std::string, std::string> entries{
      {"ends", "Specimen/Ends"},
      {"end_layer", "Specimen/End layer"},
      {"specimen.radius", "Specimen/Sphere radius"},
      {"platens.strip_width", "Platens/Strip width"},
      {"platens.span", "Platens/Span"},
      {"platens.elements_across", "Platens/Elements across"},
      {"platens.top.grid", "Platens/Top/Mesh file"},
      {"platens.bottom.grid", "Platens/Bottom/Mesh file"},
      {"platens.elastic.pad", "Platens/Pad modulus, Pad Poisson ratio and Pad density"},
      {"loading.rate", "Loading/Axial rate"},
      {"loading.wave_transits", "Loading/Wave crossings"},
      {"loading.rate_multiplier", "Loading/Hurry"},
      {"loading.start_strain", "Loading/Start strain"},
      {"loading.cell", "Loading/Confinement"},
      {"loading.cell.ramp", "Loading/Confining ramp"},
      {"sleeve.elements_around", "Sleeve/Elements around"},
      {"time_step.safety", "Integration/Safety"},
      {"time_step.fixed_step", "Integration/Time step"}};
  const auto found = entries.find(member);
  return found == entries.end() ? member : found->second;
}

std::string with_entries(const std::string &message) {
  std::string text;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t open = message.find('`', at), close = message.find('`', open + 1);
    if (open == std::string::npos || close == std::string::npos) return text + message.substr(at);
    text += message.substr(at, open - at) + entry_of_member(message.substr(open + 1, close - open - 1));
    at = close + 1;
  }
  return text;
}

void refuse(const Scene &scene, const std::string &path, const std::string &reason) {
  if (scene.parameters) scene.parameters->refuse(path, reason);
  throw InputError(path + " " + reason);
}

void refuse(const Scene &scene, const coupling::BadSetup &error) {
  refuse(scene, entry_of_member(error.member()), with_entries(error.reason()));
}

} // namespace platen::apps
