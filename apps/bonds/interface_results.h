// What platen-bonds writes and shows of bonds that remember, beside what it does of all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/bonds/run_bonds.h"
#include "apps/io/summary.h"

namespace platen::apps {

// The scene's bond is led by interface_rig.h.
bool is_led(const Scene &scene);

BondRun lead_bond(const Scene &scene, double modulus);

// bonds.csv: the columns of all bonds, where `by_hand` is the load (N) at the row's place and `difference`
// the larger one of both loads over the largest load by hand; then damage and energies.
void write_interface_table(const std::filesystem::path &path, const Scene &scene,
                           const std::vector<BondRun> &runs);
std::string interface_report(const Scene &scene, const std::vector<BondRun> &runs);
void add_interface_summary(const BondRun &run, Json &to);

} // namespace platen::apps
