#include "apps/io/vtk_xml.h"

#include <vtkObject.h>
#include <vtkXMLUtilities.h>

#include <sstream>

namespace platen::apps {

std::string escaped_xml(const std::string &text) {
  std::ostringstream result;
  vtkXMLUtilities::EncodeString(text.c_str(), VTK_ENCODING_NONE, result, VTK_ENCODING_NONE, 1);
  return result.str();
}

vtkSmartPointer<vtkXMLDataElement> read_xml(const std::filesystem::path &path) {
  const int warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::SetGlobalWarningDisplay(0);
  auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  vtkObject::SetGlobalWarningDisplay(warnings);
  return root;
}

} // namespace platen::apps
