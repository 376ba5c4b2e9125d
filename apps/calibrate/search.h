// Bonds for a wanted material: what static solves tell by their parameters first, then all targets by all
// parameters that are free, by least squares on a model of the trials (response_model.h).
#pragma once

#include <functional>
#include <optional>

#include "apps/calibrate/space.h"

namespace platen::apps {

// What is measured of choices, one after the other, on all packings; `elastic_alone`: by static solves alone.
using Measurement =
    std::function<std::vector<Measured>(const std::vector<Choice> &choices, bool elastic_alone)>;

// How the responses of the wanted goals go with what is free, at the best trial.
struct Sensitivities {
  std::vector<std::size_t> goals;
  std::vector<ParameterFacts> free;
  Eigen::MatrixXd slopes; // changes of responses (rows of Goals::responses) by logarithms of the parameters
  Eigen::VectorXd responses; // there
  bool measured = false;     // by differences and trials; else the trials have only corrected a guess
};

struct Found {
  Choice choice;
  Measured measured;
  int trials = 0; // with moving platens
  Sensitivities sensitivities;
  std::vector<std::string> at_bounds; // of the free parameters, one line each
};

// Judges what was found on further packings: what the trials are to be corrected by where these miss a goal,
// nothing where the search is over.
using Judge = std::function<std::optional<Correction>(const Found &)>;

// Ends where every goal is within its tolerance less two standard errors of its mean, or, after half of the
// trials, within its tolerance; after Calibrate/Most trials, or where the bounds allow nothing better. Goes
// on with the trials that are left where `judge` asks for it. Throws NumericsError where no runs come to a
// peak, or no static solve to an end.
Found search(const Scene &scene, const Goals &goals, const Measurement &test, const Judge &judge = {});

} // namespace platen::apps
