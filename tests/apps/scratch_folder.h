// A folder of its own for each test, gone afterwards.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace platen::apps::testing {

namespace fs = std::filesystem;

class ScratchFolder : public ::testing::Test {
protected:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "platen_output_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch folder");
    root_ = folder_ = pattern;
  }
  ~ScratchFolder() override {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  fs::path folder_;

private:
  fs::path root_; // a test may go to a folder within
};

// One that all tests of this process share, gone at its end.
inline const fs::path &process_folder() {
  static const struct Kept : ScratchFolder {
    void TestBody() override {}
    const fs::path &path() const { return folder_; }
  } kept;
  return kept.path();
}

inline std::string content_of(const fs::path &path) {
  std::ifstream stream(path, std::ios::binary);
  EXPECT_TRUE(stream.good()) << path;
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void put(const fs::path &path, const std::string &content) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << content;
}

// What `act` throws as an Error; a failed expectation where it throws nothing or something else.
template <class Error, class Act>
std::string message_of(const Act &act) {
  try {
    act();
  } catch (const Error &error) {
    return error.what();
  } catch (const std::exception &error) {
    ADD_FAILURE() << "another exception: " << error.what();
    return "";
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

// Whether a text holds a part; a failed expectation shows both.
inline ::testing::AssertionResult contains(const std::string &text, const std::string &part) {
  const bool found = text.find(part) != std::string::npos;
  return ::testing::AssertionResult(found) << text << "\n holds " << (found ? "" : "no ") << part;
}

} // namespace platen::apps::testing
