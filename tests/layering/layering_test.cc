#include "layering/layering.h"

#include <gtest/gtest.h>

using platen::layering::check_source;
using platen::layering::check_tree;

namespace {

std::size_t faults(const std::string &folder, const std::string &text) {
  return check_source(folder, "some.cc", text).size();
}

TEST(Layering, no_source_of_this_project_breaks_the_layers) {
  const auto survey = check_tree(PLATEN_SOURCE_DIR);
  EXPECT_GT(survey.files, 5); // an empty tree proves nothing
  for (const auto &violation : survey.violations)
    ADD_FAILURE() << violation.file << ":" << violation.line << ": " << violation.what;
}

TEST(Layering, particles_may_not_include_elements_coupling_apps_or_big_libraries) {
  for (const char *path : {"\"fem/surface_mesh.h\"", "\"coupling/problem.h\"", "\"apps/output/output.h\"",
                           "\"../fem/surface_mesh.h\"", "<deal.II/base/tensor.h>", "<vtkPoints.h>", "<mpi.h>",
                           "<Epetra_CrsMatrix.h>", "<Teuchos_RCP.hpp>", "<ml_epetra_utils.h>", "<fstream>"})
    EXPECT_EQ(faults("dem", std::string("#include ") + path + "\n"), 1u) << path;
  for (const char *path : {"\"dem/bonds.h\"", "\"base/table.h\"", "<vector>", "<Eigen/Dense>",
                           "<tbb/parallel_for.h>", "<cstdio>"})
    EXPECT_EQ(faults("dem", std::string("#include ") + path + "\n"), 0u) << path;
}

TEST(Layering, ranks_know_particles_and_mpi_and_nobody_below_knows_ranks) {
  const std::string ranks = "#include \"dist/partition.h\"\n";
  for (const char *folder : {"base", "dem", "fem"})
    EXPECT_EQ(faults(folder, ranks), 1u) << folder;
  for (const char *folder : {"base", "dem"})
    EXPECT_EQ(faults(folder, "#include <mpi.h>\n#include <zoltan.h>\n"), 2u) << folder;
  EXPECT_EQ(faults("coupling", ranks), 0u);
  for (const char *path : {"\"base/vector3.h\"", "\"dem/pair_blocks.h\"", "<mpi.h>", "<zoltan.h>"})
    EXPECT_EQ(faults("dist", std::string("#include ") + path + "\n"), 0u) << path;
  for (const char *path : {"\"fem/body.h\"", "\"coupling/experiment.h\"", "\"apps/output/file.h\"",
                           "<deal.II/base/mpi.h>", "<vtkPoints.h>", "<Tpetra_Map.hpp>", "<fstream>"})
    EXPECT_EQ(faults("dist", std::string("#include ") + path + "\n"), 1u) << path;
}

TEST(Layering, a_header_of_ranks_asks_for_no_partitioner) {
  EXPECT_EQ(check_source("dist", "dist/cut.h", "#include <zoltan.h>\n").size(), 1u);
  EXPECT_EQ(check_source("dist", "dist/cut.h", "#include <mpi.h>\n").size(), 0u);
}

TEST(Layering, laws_and_contacts_include_nothing_of_what_uses_them) {
  const auto count = [](const std::string &folder, const std::string &file, const std::string &path) {
    return check_source(folder, file, "#include \"" + path + "\"\n").size();
  };
  EXPECT_EQ(count("dem", "dem/laws/a.h", "dem/bonds.h"), 1u);
  EXPECT_EQ(count("dem", "dem/laws/a.h", "dem/laws/bond_layout.h"), 0u);
  EXPECT_EQ(count("dem", "dem/bonds.h", "dem/laws/bond_layout.h"), 0u);
  EXPECT_EQ(count("coupling", "coupling/contact/a.cc", "coupling/program/drive.h"), 1u);
  EXPECT_EQ(count("coupling", "coupling/contact/a.cc", "coupling/boundary.h"), 1u);
  EXPECT_EQ(count("coupling", "coupling/contact/a.cc", "coupling/contact/faces.h"), 0u);
  EXPECT_EQ(count("coupling", "coupling/program/a.h", "coupling/boundaries/sleeve.h"), 1u);
  EXPECT_EQ(count("coupling", "coupling/program/a.h", "coupling/boundary.h"), 0u);
}

TEST(Layering, elements_may_not_include_particles_and_coupling_may_include_both) {
  const std::string particles = "#include \"dem/bonds.h\"\n", elements = "#include \"fem/surface_mesh.h\"\n";
  const std::string coupling = "#include \"coupling/problem.h\"\n",
                    apps = "#include \"apps/output/output.h\"\n";
  EXPECT_EQ(faults("fem", particles + coupling + apps), 3u);
  EXPECT_EQ(faults("fem", elements + "#include <deal.II/base/tensor.h>\n"), 0u);
  EXPECT_EQ(faults("coupling", particles + elements + coupling), 0u);
  EXPECT_EQ(faults("coupling", apps), 1u);
}

TEST(Layering, the_common_ground_knows_nobody) {
  for (const char *path : {"\"dem/table.h\"", "\"fem/surface_mesh.h\"", "\"coupling/problem.h\"",
                           "\"apps/output/output.h\"", "<deal.II/base/tensor.h>", "<fstream>"})
    EXPECT_EQ(faults("base", std::string("#include ") + path + "\n"), 1u) << path;
  EXPECT_EQ(faults("base", "#include \"base/range.h\"\n"), 0u);
  EXPECT_EQ(faults("dem", "#include \"base/range.h\"\n"), 0u);
}

TEST(Layering, numerics_may_not_open_a_file) {
  for (const char *statement :
       {"std::ofstream out(name);", "std::ifstream in(name);", "std::fopen(name, \"r\");",
        "FILE *f = fopen(name, m);", "int fd = ::open(name, O_RDONLY);", "int fd = open(name, O_RDONLY);",
        "std::filesystem::remove(name);", "data_out.write_vtu_in_parallel(name, comm);"})
    for (const char *folder : {"base", "dem", "dist", "fem", "coupling"})
      EXPECT_EQ(faults(folder, std::string(statement) + "\n"), 1u) << folder << ": " << statement;
}

TEST(Layering, a_function_that_differs_by_processor_is_left_to_measures) {
  for (const char *call : {"std::exp(x)", "std::pow(x, 2)", "std::sin (x)", "std::acos(x)",
                           "std::atan2(y, x)", "std::tgamma(x)", "std::log(x)", "std::tanh(x)"}) {
    const std::string text = std::string("const double y = ") + call + ";\n";
    for (const char *folder : {"base", "dem", "dist", "fem", "coupling"})
      EXPECT_EQ(faults(folder, text), 1u) << folder << ": " << call;
    EXPECT_EQ(check_source("dem", "dem/measure/cone.cc", text).size(), 0u);
    EXPECT_EQ(faults("apps", text), 0u);
  }
  for (const char *call : {"std::sqrt(x)", "std::cbrt(x)", "portable::exp(x)", "std::abs(x)", "loss.cos(x)"})
    EXPECT_EQ(faults("dem", std::string(call) + ";\n"), 0u) << call;
}

TEST(Layering, the_library_names_no_entry_of_a_scene) {
  for (const char *folder : {"base", "dem", "dist", "fem", "coupling"}) {
    EXPECT_EQ(faults(folder, "throw Bad(\"try a smaller Loading/Axial rate\");\n"), 1u) << folder;
    EXPECT_EQ(faults(folder, "throw Bad(\"Sleeve/Elements around\" + why);\n"), 1u) << folder;
  }
  for (const char *text :
       {"// as Loading/Axial rate has it\n", "throw Bad(\"try a smaller `loading.rate`\");\n",
        "/* Platens/Span */ int a = b / c;\n", "const double x = Bond / Area;\n"})
    EXPECT_EQ(faults("coupling", text), 0u) << text;
  EXPECT_EQ(faults("apps", "refuse(\"Loading/Axial rate\");\n"), 0u);
}

TEST(Layering, words_in_comments_and_strings_and_gaps_that_open_are_no_files) {
  for (const char *text : {"// opens no std::ofstream", "/* fopen(\n std::ifstream */",
                           "throw E(\"fopen( failed\");", "const bool is_open = gap.open();",
                           "set_open(true);", "bond->open(0);", "// #include \"fem/surface_mesh.h\""})
    EXPECT_EQ(faults("dem", std::string(text) + "\n"), 0u) << text;
}

TEST(Layering, the_line_of_a_fault_is_told_past_comments) {
  const auto found = check_source("dem", "a.h", "// one\n/* two\n three */\n#include \"fem/body.h\"\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].line, 4);
  EXPECT_EQ(found[0].file, "a.h");
}

TEST(Layering, apps_are_free) {
  EXPECT_EQ(faults("apps", "#include <fstream>\nstd::ofstream out(name);\n"), 0u);
}

} // namespace
