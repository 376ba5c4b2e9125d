// Failure under pressure: the lines of Mohr and Coulomb, and the curves of Hoek and Brown, through the
// strengths of cases that differ by the pressure on their sides alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/scene/values.h"
#include "apps/study/cases.h"

namespace platen::apps {

struct FailurePoint { // of one run; Pa, compression positive
  double pressure;    // s3, on the sides
  double strength;    // s1, along the axis
};

// s1 = q + k s3 by least squares, the same as Mohr-Coulomb: sin phi = (k - 1) / (k + 1), c = q / (2 sqrt k);
// and Hoek and Brown's curve of intact rock (1980), s1 = s3 + sc sqrt(m s3 / sc + 1), by least squares of
// (s1 - s3)^2. Pa and degrees. Errors are standard errors; those of c and phi follow from those of q and k
// and their covariance to first order. NaN: what `reason` says.
struct FailureLine {
  std::size_t runs = 0;
  double pressure_low = not_given, pressure_high = not_given;
  double cohesion = not_given, cohesion_error = not_given;
  double friction_angle = not_given, friction_angle_error = not_given;
  double q = not_given, q_error = not_given, k = not_given, k_error = not_given;
  double residual_error = not_given; // standard deviation of a strength about the line
  double largest_miss = not_given;   // of the mean strength at a pressure by the line, over that strength
  double hoek_brown_sc = not_given, hoek_brown_m = not_given;
  std::string reason = {}; // why numbers are missing, and which runs are
};
FailureLine fit_failure_line(const std::vector<FailurePoint> &points);

struct FailureEnvelope {
  std::string name;                       // StudyCase::envelope
  std::vector<std::size_t> cases;         // StudyPlan::cases
  FailureLine line;                       // through all runs
  std::vector<FailureLine> packings = {}; // through those of each seed, where there are several
};

// One for each group of cases of at least two pressures that are equal in all else. `strengths`: of all runs
// (Pa; NaN: failed or never peaked), by case, then by seed.
std::vector<FailureEnvelope> failure_envelopes(const StudyPlan &plan,
                                               const std::vector<std::vector<double>> &strengths);

// For study.json; repeats to the byte.
Json json_of(const StudyPlan &plan, const std::vector<FailureEnvelope> &envelopes);
// The same as envelope.csv, a row each. Throws OutputError.
void write_envelopes(const std::filesystem::path &csv, const StudyPlan &plan, const Json &envelopes);
// For the screen; "" of nothing.
std::string text_of(const std::vector<FailureEnvelope> &envelopes);

} // namespace platen::apps
