#include "apps/report/embedded.h"

#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkUnsignedCharArray.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "apps/output/file.h"
#include "apps/report/base64.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

constexpr int jpeg_quality = 90; // of 100: no edge of a letter is seen to blur

std::vector<unsigned char> bytes_of(const std::filesystem::path &file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream || bytes.empty()) throw OutputError(file.string() + ": cannot be read back");
  return bytes;
}

std::vector<unsigned char> as_jpeg(const std::filesystem::path &png) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  vtkNew<vtkJPEGWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetQuality(jpeg_quality);
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray *result = writer->GetResult();
  if (result == nullptr) return {};
  const unsigned char *first = const_cast<vtkUnsignedCharArray *>(result)->GetPointer(0);
  return {first, first + result->GetNumberOfValues()};
}

} // namespace

std::string source_of_picture(const std::filesystem::path &png) {
  const std::vector<unsigned char> bytes = bytes_of(png), jpeg = as_jpeg(png);
  const bool smaller = !jpeg.empty() && 2 * jpeg.size() < bytes.size();
  return smaller ? "data:image/jpeg;base64," + base64(jpeg) : "data:image/png;base64," + base64(bytes);
}

} // namespace platen::apps::report
