// Rows of a bar's history.csv: the common columns, of which a bar without platens fills some, and its own.
#pragma once

#include <string>
#include <vector>

#include "apps/bar/run_bar.h"
#include "apps/io/csv_writer.h"

namespace platen::apps {

std::vector<std::string> bar_columns();
// With a ledger: energies are kept; without it their columns are NaN.
std::vector<CsvCell> bar_row(const BarSample &s, BarLoad load, const BarResults &results, bool ledger);

} // namespace platen::apps
