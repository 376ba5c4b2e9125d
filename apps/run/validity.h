// May a figure of a test be used? Reasons against each; one with a reason is not printed as a result.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/run/results.h"
#include "apps/scene/scene.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// By the keys of summary.json.
class Validity {
public:
  void add(const std::vector<const char *> &figures, const std::string &reason);
  bool holds(const std::string &figure) const { return reasons(figure).empty(); }
  const std::vector<std::string> &reasons(const std::string &figure) const;
  // The value; NaN where there is a reason against the figure.
  double of(const std::string &figure, double value) const { return holds(figure) ? value : not_measured; }
  // Figures with a reason become null; member "validity" names each headline figure that the summary has,
  // with "valid" or the reasons against it.
  void complete(Json &summary) const;

private:
  std::map<std::string, std::vector<std::string>> reasons_;
};

// Of a test between platens, as far as it has come.
Validity judge(const Scene &scene, const coupling::PlatenTest &problem, const Results &results);

} // namespace platen::apps
