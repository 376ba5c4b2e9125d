// Small XML files of VTK's: what they list. For apps/io alone, and for apps that link VTK.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>

#include <filesystem>
#include <string>

namespace platen::apps {

// As it may stand in an attribute.
std::string escaped_xml(const std::string &text);

// Null where the file is missing or damaged; VTK would print words of its own besides what the caller throws.
vtkSmartPointer<vtkXMLDataElement> read_xml(const std::filesystem::path &path);

} // namespace platen::apps
