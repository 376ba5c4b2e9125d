// Figures that a test reaches, beside what they are held against: they go out with --gtest_output=json, and
// scripts/verification.py makes a table of them (docs/verification.md).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

namespace platen::measured {

// Notes a figure of this test for a row of tests/verification/rows.json, the last one where it notes it
// again. `what`: words joined by "_". `allowed`: what the test asks of it, as "< 1e-10".
inline void note_figure(int row, const std::string &what, double value, const std::string &allowed) {
  std::ostringstream text;
  text.precision(std::floor(value) == value ? 9 : 2); // counts whole
  text << value << " " << allowed;
  testing::Test::RecordProperty("row_" + std::to_string(row) + "_" + what, text.str());
}

// Expects value < limit and notes both.
inline void expect_below(int row, const std::string &what, double value, double limit) {
  std::ostringstream allowed;
  allowed << "< " << limit;
  note_figure(row, what, value, allowed.str());
  EXPECT_LT(value, limit) << what;
}

} // namespace platen::measured
