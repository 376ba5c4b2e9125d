#include "apps/report/base64.h"

#include <vtkBase64Utilities.h>

namespace platen::apps::report {

std::string base64(const std::vector<unsigned char> &bytes) {
  if (bytes.empty()) return "";
  std::string text(bytes.size() / 3 * 4 + 8, '\0');
  const auto length =
      vtkBase64Utilities::Encode(bytes.data(), bytes.size(), reinterpret_cast<unsigned char *>(text.data()));
  text.resize(length);
  return text;
}

} // namespace platen::apps::report
