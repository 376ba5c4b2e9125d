// Few dear trials towards wanted responses: a linear model of the logarithms of measured over wanted, fitted
// to the trials so far and begun from a guess, whose sum of squares NLopt makes least within bounds. Trials
// are noisy (other round-off breaks other bonds), so that a search for the least of the trials themselves
// goes astray or takes many.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace platen::apps {

// What the search may change, in units of which one is a large change.
struct SearchParameter {
  double start = 0, low = 0, high = 0;
  double step = 0;    // most between the best trial and the next
  bool known = false; // the guess is exact: trials do not change it
};

class ResponseModel {
public:
  // `guess`: change of each response (row) with each parameter (column). Starts beyond the bounds are moved
  // to them. Parameters nearer to each other than `same` are the same.
  ResponseModel(std::vector<SearchParameter> parameters, Eigen::MatrixXd guess, double same = 1e-3);

  // A trial and its responses: zero is what is wanted.
  void add(const Eigen::VectorXd &parameters, const Eigen::VectorXd &responses);

  Eigen::VectorXd start() const;
  // Where the model has its least sum of squares, a step about the best trial; nothing where that has been
  // tried.
  std::optional<Eigen::VectorXd> next() const;
  std::size_t best() const;       // the trial with the least sum of squares
  Eigen::MatrixXd slopes() const; // as the guess, fitted to the trials

private:
  struct Tried {
    Eigen::VectorXd parameters, responses;
  };
  std::vector<SearchParameter> parameters_;
  Eigen::MatrixXd guess_;
  double same_;
  std::vector<Tried> tried_;
};

} // namespace platen::apps
