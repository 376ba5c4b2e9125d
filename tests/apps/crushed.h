// Runs of crushed.prm, the small cylinder that breaks.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {

class Crushed : public ScratchFolder {
protected:
  // Runs crushed.prm with entries of its own into the folder `name`; gives the summary.
  nlohmann::json crush(const std::string &name, const std::vector<std::string> &entries) {
    std::vector<std::string> arguments{test_scene("crushed.prm"), "-o", name, "--quiet", "-s",
                                       "Output/Fields = off"};
    for (const std::string &entry : entries)
      arguments.insert(arguments.end(), {"-s", entry});
    const Outcome outcome = run_compress(arguments, folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    return summary_in(folder_ / name);
  }
};

} // namespace platen::apps::testing
