// Linked into the test programs of a mutated copy (scripts/mutation.py): writes a line for each test into the
// file of PLATEN_FAULTS_REACHED: name, time in s, the faults that it came by.
#include <gtest/gtest.h>

#include <cstdio>

namespace {

class Reached : public testing::EmptyTestEventListener {
  // Constants come by their faults before any test does: every test may feel them.
  void OnTestProgramStart(const testing::UnitTest &) override {
    for (int number = 0; number < platen::fault::most; ++number)
      at_start_[number] = platen::fault::reached[number];
  }
  void OnTestEnd(const testing::TestInfo &test) override {
    const char *path = std::getenv("PLATEN_FAULTS_REACHED");
    if (path == nullptr) return;
    std::FILE *file = std::fopen(path, "a");
    if (file == nullptr) return;
    const std::string children = std::string(path) + ".children";
    if (std::FILE *left = std::fopen(children.c_str(), "r")) {
      for (int number = 0; std::fscanf(left, "%d", &number) == 1;)
        platen::fault::reached[number] = 1;
      std::fclose(left);
      std::remove(children.c_str());
    }
    const testing::TestResult &result = *test.result();
    std::fprintf(file, "%s.%s %s %.3f", test.test_suite_name(), test.name(),
                 result.Failed() ? "failed" : "passed", 1e-3 * static_cast<double>(result.elapsed_time()));
    for (int number = 0; number < platen::fault::most; ++number)
      if (platen::fault::reached[number] || at_start_[number]) {
        std::fprintf(file, " %d", number);
        platen::fault::reached[number] = 0;
      }
    std::fprintf(file, "\n");
    std::fclose(file);
  }

  bool at_start_[platen::fault::most] = {};
};

const bool listens = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Reached);
  return true;
}();

} // namespace
