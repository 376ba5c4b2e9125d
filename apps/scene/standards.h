// Scene/Standard: the standard by which a test is reported. It changes nothing of the test: platen-report
// --standard reads the figures off the results (python/platen/report/standard.py). Here is which tests are
// the standard's.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "apps/scene/program.h"
#include "apps/scene/quantities.h"

namespace platen::apps {

struct TestStandard {
  std::string word;
  Presses presses = Presses::specimens;
  bool prisms = false, confined = false; // allowed besides cylinders without a cell
  bool cycles = false;                   // stages lead through cycles of loading
  double least_slenderness = 0,
         most_slenderness = std::numeric_limits<double>::infinity(); // height over the least width
};

const std::vector<TestStandard> &test_standards();
Words<std::string> words_of_standards(); // and "none"

} // namespace platen::apps
