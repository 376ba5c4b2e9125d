// May a figure of a test be used? Reasons against each; a figure with a reason is null.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/run/figures.h"
#include "apps/run/test_record.h"

namespace platen::apps {

// By the keys of summary.json; figures that nothing speaks against are not in it.
using Reasons = std::map<std::string, std::vector<std::string>>;

// Of figures that have been computed: `values` has them by their keys.
Reasons reasons_against(const TestRecord &test, const std::vector<Figure> &figures, const Json &values);

} // namespace platen::apps
