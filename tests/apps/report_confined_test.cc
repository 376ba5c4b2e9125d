// Strains of a confined test count from the end of its consolidation, in pictures as in the summary.
#include <gtest/gtest.h>

#include "apps/report/run_folder.h"
#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

// Three rows of consolidation to 4 MPa, which shorten the specimen by .1 mm/m; the peak at 1.4 mm/m.
void write_confined(const TestFolder &folder, const std::string &summary) {
  folder.write("history.csv",
               "time_s,axial_strain_platen,axial_stress_top_pa,axial_stress_bottom_pa,confining_pressure_pa\n"
               "0,0,0,0,0\n1,5e-5,2e6,2e6,2e6\n2,1e-4,4e6,4e6,4e6\n3,9e-4,40e6,40e6,4e6\n"
               "4,1.4e-3,61e6,61e6,4e6\n5,2e-3,30e6,30e6,4e6\n");
  folder.write("summary.json", summary);
}

TEST(ReportConfined, strain_at_the_peak_is_the_summarys) {
  const TestFolder folder;
  for (const char *summary : {R"({"consolidation_end_time_s": 2.0, "strain_at_peak_platen": 0.0013})",
                              R"({"strain_at_peak_platen": 0.0013})"}) { // an older one
    write_confined(folder, summary);
    const report::Run run = read_run(folder.path());
    EXPECT_EQ(run.zero, 2u) << summary;
    EXPECT_NEAR(run.strain()[run.moments.peak_row], 1.3e-3, 1e-12);
    EXPECT_EQ(run.strain_title(), "Axial strain between platens from the end of consolidation (mm/m)");
    EXPECT_EQ(run.from_zero(run.strain()).size(), 4u);
    EXPECT_EQ(run.from_zero(run.strain()).front(), 0);
  }
}

TEST(ReportConfined, without_a_consolidation_strains_count_from_the_start) {
  const TestFolder folder;
  for (const char *summary : {R"({"consolidation_end_time_s": null, "strain_at_peak_platen": 0.0014})",
                              R"({"strain_at_peak_platen": 0.0014})", "{}"}) {
    write_confined(folder, summary);
    const report::Run run = read_run(folder.path());
    EXPECT_EQ(run.zero, 0u) << summary;
    EXPECT_EQ(run.strain()[run.moments.peak_row], 1.4e-3);
    EXPECT_EQ(run.strain_title(), "Axial strain between platens (mm/m)");
  }
}

} // namespace
} // namespace platen::apps::report
