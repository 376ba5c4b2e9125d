// What platen-compress refuses, and how: the exit status, one message that names the place, and nothing
// written. Most faults of a scene alone are in tests/apps/faulty.txt.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

struct Refusal {
  Words arguments; // beside `-o results`
  Words says;      // what the message has to hold
};

class Errors : public Crushed {
protected:
  Errors() : Crushed("crushed.prm", Frames::as_in_the_scene) {}

  Words names() const {
    Words all;
    for (const auto &entry : fs::recursive_directory_iterator(folder_))
      all.push_back(entry.path().lexically_relative(folder_).string());
    std::sort(all.begin(), all.end());
    return all;
  }
  // Exit status 2, one message with all that is asked for, no output folder.
  void refuse(const Refusal &bad, const std::string &output = "results", bool briefly = true) {
    put(folder_ / "out.txt", "");
    put(folder_ / "error.txt", "");
    const Words before = names();
    const Outcome outcome = run_compress(with(bad.arguments, {"-o", output}), folder_);
    EXPECT_EQ(outcome.status, 2) << outcome.error;
    EXPECT_EQ(outcome.out, "");
    for (const std::string &part : bad.says)
      EXPECT_TRUE(contains(outcome.error, part));
    if (briefly) {
      EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    }
    EXPECT_EQ(names(), before) << bad.says.front();
  }
  void refuse_scene(const std::string &lines, const Words &says) {
    scene("bad.prm", lines);
    refuse({{"bad.prm"}, says});
  }
  // The crushed cylinder with entries, by command line.
  void refuse_entries(const Words &entries, const Words &says, const Words &options = {}) {
    refuse({with(with({scene_}, set(entries)), options), says});
  }
  // Of a run to its end, which need not be a good one.
  Outcome run(const Words &entries, const Words &options = {}) const {
    return run_compress(arguments("results", entries, options), folder_);
  }
};

// By file and line where the scene has it; what is found once spheres are packed and bonded is told so too.
TEST_F(Errors, faulty_scenes_are_refused_by_file_and_line) {
  refuse_scene("subsection Bond\n  set Modulos = 3 GPa\nend\n",
               {"bad.prm:3: error: Bond/Modulos is not a parameter. Did you mean \"Bond/Modulus\""});
  refuse_scene("subsection Bonds\nend\n", {"bad.prm:2: error: ", "Bond"});
  refuse_scene("subsection Bond\n  set Modulus = 3 GPa\n  set Modulus = 4 GPa\nend\n",
               {"bad.prm:4: error: Bond/Modulus = 4 GPa is set twice", "bad.prm:3"});
  refuse_scene("subsection Effects\n  set Bond = paralel bond\nend\n",
               {"bad.prm:3", "paralel", "parallel bond"});
  refuse_scene("subsection Specimen\n  set Sphere radius = -1 mm\nend\n",
               {"bad.prm:3", "Specimen/Sphere radius = -1 mm"});
  refuse_scene("subsection Bond\n  set Modulus = 36 GPa m\nend\n",
               {"bad.prm:3", "Bond/Modulus", "a pressure (Pa)"});
  refuse_scene("subsection Specimen\n  set Sphere radius = 11 mm\nend\n",
               {"bad.prm:3", "do not fit into Specimen/"});
  refuse_scene("subsection Platens\n  set Friction dynamic = 0.4\nend\n",
               {"bad.prm:3", "above the static friction, 0.3"});
  refuse_scene("subsection Loading\n  set Test = tension\nend\n",
               {"bad.prm:3", "needs Platens/Attachment = glued"});
  refuse_scene("subsection Loading\n  set Start strain = 0.008\nend\n",
               {"bad.prm:3", "Loading/Start strain = 0.008", "is not below Loading/Target strain = 0.008"});
  refuse_scene("subsection Loading\n  set Start strain = 0.006\nend\n",
               {"bad.prm:3", "Loading/Start strain = 0.006 breaks", "bonds at once"});
  refuse_scene(
      "subsection Effects\n  set Gravity = on\nend\nsubsection Loading\n"
      "  set Start strain = 0.001\nend\n",
      {"bad.prm:6", "does not go with gravity. Allowed: 0."});
  refuse_scene(
      "subsection Effects\n  set Bond = yielding parallel bond\nend\nsubsection Loading\n"
      "  set Start strain = 0.001\nend\n",
      {"bad.prm:6", "needs bonds without a memory: theirs answer to the whole path. Allowed: 0."});
  refuse_scene("subsection Loading\n  set Test = hydrostatic\nend\n",
               {"bad.prm:3", "needs Loading/Confinement = particles, sleeve"});
  refuse_scene("subsection Loading\n  set Confinement = particles\nend\n",
               {"bad.prm:3", "needs Loading/Confining pressure > 0"});
  refuse_scene("subsection Loading\n  set Unload at = 0.003, 0.002\nend\n", {"bad.prm:3", "does not ascend"});
  refuse_scene("subsection Loading\n  set Unload at = 0.05\nend\n",
               {"bad.prm:3", "goes beyond Loading/Target strain = 0.008"});
  refuse_scene("subsection Expect\n  set strenth_pa = 1 ... 2\nend\n",
               {"bad.prm:3", "strenth_pa", "strength_pa"});
}

TEST_F(Errors, bad_command_lines_are_refused) {
  refuse({{}, {"no scene is given"}});
  refuse({{"nowhere.prm"}, {"nowhere.prm: error: cannot be read"}});
  refuse({{scene_, "--glue"}, {"--glue is not an option"}});
  refuse({{scene_, "another.prm"}, {"one argument too many"}});
  refuse({{scene_, "-t", "0"}, {"--threads = 0"}});
  refuse({{scene_, "-t", "two"}, {"--threads = two"}});
  refuse({{scene_, "-s", "Bond/Modulus"}, {"--set 1: error: \"Bond/Modulus\" sets nothing"}});
  refuse(
      {{scene_, "-s", "Bond/Modulus = 4 GPa", "-s", "Bond/Gap = 4 s"}, {"--set 2: error: Bond/Gap = 4 s"}});
  refuse({{scene_, "--resume", "--overwrite"}, {"exclude each other"}});
}

TEST_F(Errors, a_time_step_above_the_limit_is_refused_with_the_limit) {
  scene("bad.prm", "subsection Integration\n  set Time step = 1 us\nend\n");
  refuse({{"bad.prm"},
          {"bad.prm:3: error: Integration/Time step = 1 us is above the stability limit of ", "e-07 s"}});
}

// A pipe that nobody writes into and a device that never ends kept the program waiting, the second with all
// memory.
TEST_F(Errors, pipes_and_devices_are_no_files_and_nothing_waits_for_them) {
  const auto refused = [&](const Words &arguments, const std::string &says) {
    Program program(compress_command(with(arguments, {"-o", "results"})), folder_);
    const auto start = std::chrono::steady_clock::now();
    const bool waits = program.wait_until(
        [&] { return std::chrono::steady_clock::now() - start > std::chrono::seconds(20); });
    ASSERT_FALSE(waits) << says;
    EXPECT_EQ(program.wait(), 2) << says;
    const std::string error = content_of(folder_ / "error.txt");
    EXPECT_TRUE(contains(error, says));
    EXPECT_FALSE(fs::exists(folder_ / "results"));
  };
  const std::string pipe = (folder_ / "pipe").string(), scene_pipe = pipe + ".prm";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(scene_pipe.c_str(), 0600), 0);
  refused({scene_pipe}, "pipe.prm: error: cannot be read: it is a pipe or a device");
  put(folder_ / "in.prm", "include pipe.prm\n");
  refused({"in.prm"}, "in.prm:1: error: include pipe.prm: ");
  put(folder_ / "in.prm", "include /dev/zero\n");
  refused({"in.prm"}, "in.prm:1: error: include /dev/zero: ");
  for (const std::string &file : {pipe, std::string("/dev/zero")}) {
    for (const Words &entries : {Words{"Specimen/Packing = file", "Specimen/File = " + file},
                                 Words{"Phases/By = file", "Phases/File = " + file},
                                 Words{"Scene/Seed = 3", "Platens/Top/Mesh file = " + file}})
      refused(with({scene_}, set(entries)),
              "--set 2: error: " + entries[1] + " is a pipe or a device, no file");
  }
}

// What a terminal obeys does not reach it, whatever the name that it stands in.
TEST_F(Errors, control_characters_in_names_are_not_sent_to_the_terminal) {
  put(folder_ / "e\x1b[31m/history.csv", "run");
  for (const Words &arguments : {Words{scene_, "-o", "e\x1b[31m"},
                                 {scene_, "-o", "a\nb"},
                                 {"a\x1b[2J\n.prm"},
                                 {scene_, "--out\x1b[31mput"},
                                 {scene_, "-s", "Bond/\x1b[31mModulus = 3"},
                                 {scene_, "-s", "Bond/Modulus = \x1b[2J"},
                                 {scene_, "\x1b[2J"}}) {
    const Outcome outcome = run_compress(arguments, folder_);
    EXPECT_EQ(outcome.status, 2) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_FALSE(contains(outcome.error, "\x1b"));
  }
}

// Nothing of what is there is changed.
TEST_F(Errors, output_folders_are_guarded_and_refused_by_name) {
  const std::string longest(300, 'x');
  put(folder_ / "file", "mine");
  put(folder_ / "used/history.csv", "time_s\n");
  fs::create_symlink("loop", folder_ / "loop");
  fs::copy_file(scene_, folder_ / "scene.prm");
  const std::string root = "is the root of the file system; choose another folder";
  for (const auto &[output, says] : std::vector<std::pair<std::string, Words>>{
           {longest, {"output folder " + longest + ": File name too long"}},
           {"file", {"output folder file: ", "is not a folder"}},
           {"file/below", {"output folder file/below: ", "is not a folder"}},
           {"loop", {"output folder loop: ", "is not a folder"}},
           {"/", {root}},
           {"//", {root}},
           {"/tmp/..", {root}},
           {"/proc/results", {"output folder /proc/results: "}}, // not even root may write there
           {"used", {"holds an earlier run (history.csv)", "--overwrite"}}})
    refuse({{scene_}, says}, output);
  refuse({{scene_, "--resume"}, {"holds no checkpoint to resume from"}});
  refuse({{"scene.prm"}, {"would replace scene.prm, which it reads"}}, "."); // by its own run
  EXPECT_EQ(content_of(folder_ / "file"), "mine");
  EXPECT_EQ(content_of(folder_ / "used/history.csv"), "time_s\n");
  EXPECT_EQ(content_of(folder_ / "scene.prm"), content_of(scene_));
}

// What a full disk does before the first file is whole.
TEST_F(Errors, a_disk_that_is_full_from_the_start_leaves_no_folder) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4096, before.rlim_max}; // less than scene.prm, more than the message
  setrlimit(RLIMIT_FSIZE, &small);
  const Outcome outcome = run_compress({scene_, "-o", "results", "--quiet"}, folder_);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(outcome.error, "error: results/scene.part.prm: cannot be written: File too large\n");
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

// What the packed specimen decides: too few steps or rows to see anything happen, or steps without end; a
// pressure faster than a wave; spheres without number, packed for hours, until all memory is gone.
TEST_F(Errors, what_the_packed_specimen_decides_is_refused_by_entry) {
  const Words pads{"Platens/Kind = deformable", "Platens/Pad thickness = 1 mm", "Platens/Pad modulus = 5 MPa",
                   "Platens/Pad Poisson ratio = 0.45", "Platens/Pad density = 1200 kg/m3"};
  for (const auto &[entries, says] : std::vector<std::pair<Words, Words>>{
           {{"Loading/Axial rate = 300", "Loading/Target strain = 0.02", "Loading/Ramp = 1 ns"},
            {"--set 1: error: Loading/Axial rate = 300 leaves ", " steps of ", "Allowed: 100 ... 1e+12."}},
           {{"Integration/Time step = 1e-17"},
            {"--set 1: error: Integration/Time step = 1e-17 leaves ", "(given by the scene)"}},
           {{"Output/Every = 4000"},
            {"--set 1: error: Output/Every = 4000 leaves ", " rows of history.csv",
             "Allowed: 5 rows or more."}},
           {{"Output/Every = 1 s"}, {"--set 1: error: Output/Every = 1 s leaves "}},
           {{"Loading/Confinement = particles", "Loading/Confining pressure = 5 MPa",
             "Loading/Confining ramp = 1 ns"},
            {"--set 3: error: Loading/Confining ramp = 1 ns raises the pressure in 1e-09 s",
             "that is a shock", "Allowed: 5"}},
           {{"Bond/Gap = 0.8 mm"},
            {"--set 1: error: Bond/Gap = 0.8 mm is more than the smallest radius, 0.00074",
             "Allowed: up to that."}},
           {{"Specimen/Sphere radius = 2 um", "Specimen/Packing = advancing front"},
            {"--set 1: error: Specimen/Sphere radius = 2 um is too small: ", "spheres or more", "Allowed: "}},
           {{"Specimen/Sphere radius = 2 um", "Specimen/Packing = random close"},
            {"--set 1: error: Specimen/Sphere radius = 2 um is too small: ", "spheres or more", "Allowed: "}},
           // They cost memory and time for nothing; with more spheres across the same elements are taken.
           {{"Platens/Elements across = 835", "Specimen/Sphere radius = 2 mm"},
            {"--set 1: error: Platens/Elements across = 835 makes elements of ",
             "of the radius of the spheres", "Allowed: up to 3"}},
           {with(pads, {"Platens/Motion = quasi-static"}),
            {"--set 6: error: Platens/Motion = quasi-static", "after its loads", "Allowed: explicit",
             "Platens/Steps per solve"}},
           {{"Platens/Contact = hertz", "Platens/Attachment = glued"},
            {"--set 1: error: Platens/Contact = hertz", "Allowed: as grains, linear"}},
           {{"Platens/Contact = hertz", "Loading/Start strain = 1e-4"},
            {"--set 2: error: Loading/Start strain = 1e-4", "linear springs"}}})
    refuse_entries(entries, says);
  for (const Words &entries :
       {Words{"Output/Every = 500"},
        {"Platens/Elements across = 300", "Specimen/Sphere radius = 2 mm"},
        // How long such a stage takes nobody knows before, nor how long a test with one, however short the
        // others.
        {"Loading/Stage 1/Axial = rate", "Loading/Stage 1/Until = stress 5 MPa"},
        {"Loading/Stage 1/Axial = rate", "Loading/Stage 1/Until = stress 5 MPa",
         "Loading/Stage 2/Axial = rate", "Loading/Stage 2/Until = strain change 1e-5"}})
    EXPECT_EQ(run(entries, {"--dry-run"}).status, 0) << entries.front();
}

TEST_F(Errors, a_stage_that_waits_for_a_stress_is_no_test_of_no_length) {
  crush("waits", {"Loading/Stage 1/Axial = rate", "Loading/Stage 1/Until = stress 5 MPa"});
}

// Counted before a sphere is packed or an element made: in less time and memory than either would take.
TEST_F(Errors, elements_without_number_are_refused_before_they_are_made) {
  const auto refused = [&](const Words &entries, const Words &says) {
    for (const char *way : {"--quiet", "--dry-run"}) {
      const auto start = std::chrono::steady_clock::now();
      refuse_entries(entries, says, {way});
      EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    }
  };
  // 7.5e5 elements a layer, 83 layers in each platen; each 40 kB.
  refused({"Platens/Kind = deformable", "Platens/Degree = 2", "Platens/Elements across = 1000"},
          {"--set 3: error: Platens/Elements across = 1000 asks for 1.2e+08 elements of the platens",
           "GB of memory or more", "Allowed: fewer, so that all fits into this machine's memory of "});
  refused({"Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa", "Sleeve/Thickness = 1 mm",
           "Sleeve/Elements around = 10000"},
          {"--set 4: error: Sleeve/Elements around = 10000 asks for 3.2e+07 elements of the sleeve",
           "Allowed: fewer"});
  // A mesh by the count in its file.
  put(folder_ / "huge.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n900000000\n");
  put(folder_ / "huge4.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n3 900000000 1 900000000\n");
  for (const char *name : {"huge.msh", "huge4.msh"})
    refused({"Platens/Top/Mesh file = " + (folder_ / name).string()},
            {"error: Platens/Top/Mesh file = ", "asks for 4.5e+08 elements of a platen", "Allowed: fewer"});
}

// A test that fits into the memory, but not into what a dry run may take, is counted alone.
TEST_F(Errors, what_would_take_all_memory_to_look_at_is_counted) {
  const auto asked = [&](int across) {
    return run({"Platens/Kind = deformable", "Platens/Degree = 2",
                "Platens/Elements across = " + std::to_string(across)},
               {"--dry-run"});
  };
  int most = 1; // that is not refused
  for (int refused = 1000; refused - most > 1;) {
    const int middle = (most + refused) / 2;
    (asked(middle).status == 2 ? refused : most) = middle;
  }
  EXPECT_GT(most, 30);
  const Outcome largest = asked(most);
  EXPECT_EQ(largest.status, 0) << largest.error;
  EXPECT_TRUE(contains(largest.out, "counted, not built: "));
  EXPECT_TRUE(contains(largest.out, " or more, memory "));
  EXPECT_TRUE(contains(largest.out, "MB or more; a dry run builds no more than an eighth"));
}

TEST_F(Errors, specimen_files_are_refused_by_line_or_sphere) {
  const std::string header = "x_m,y_m,z_m,radius_m\n";
  const auto refuse_file = [&](const std::string &text, const Words &says) {
    put(folder_ / "spheres.csv", text);
    scene("bad.prm", "subsection Specimen\n  set Packing = file\n  set File = spheres.csv\nend\n");
    refuse({{"bad.prm"}, says}, "results", false);
  };
  refuse_file("", {"holds no sphere"});
  refuse_file("0,0,0.01,0.001\n", {"csv:1: error: ", "header"});
  refuse_file(header + "0,0,0.01,0.001\n0,0,nan,0.001\n", {"csv:3: error: column z_m: \"nan\""});
  refuse_file(header + "0,0,0.01,-0.001\n", {"csv:2: error: column radius_m: -0.001 is not positive"});
  refuse_file(header + "0,0,0.01,0.001\n0,0,0.01,0.001\n",
              {"bad.prm:4", "spheres 0 and 1 have the same centre"});
  refuse_file(header + "0,0,0.01,0.001\n0,0.0098,0.01,0.001\n", {"bad.prm:4", "sphere 1 reaches 0.0008"});
  refuse_file("# shape: cylinder radius_m=0.01 height_m=0.03\n" + header + "0,0,0.01,0.001\n",
              {"crushed.prm:", "Specimen/Height = 20 mm contradicts", "0.03 m"});
  refuse_file(header + "0,0,0.01,0.001\n",
              {"Specimen/File = spheres.csv makes 1 sphere, which is no specimen"});
  // A cubic lattice in layers of 2 mm; bonds reach 0.05 mm.
  const auto lattice = [&](double radius, const std::vector<int> &layers, const std::string &more = "") {
    std::string text = header + more;
    for (const int layer : layers)
      for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j)
          text += fmt::format("{},{},{},{}\n", 2e-3 * i, 2e-3 * j, 1e-3 + 2e-3 * layer, radius);
    return text;
  };
  const std::vector<int> all{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  refuse_file(lattice(1e-3, {0, 1, 2, 3, 4, 6, 7, 8, 9}),
              {"bad.prm:4: error: Specimen/File = spheres.csv leaves the specimen in 2 pieces, the largest "
               "with 56 %"});
  refuse_file(lattice(0.95e-3, all), {"Bond/Gap = 0.05 R_min leaves no bond"});
  refuse_file(
      lattice(1e-3, all, "0,0,0.0034,0.001\n"),
      {"bad.prm:4: error: Specimen/File = spheres.csv has spheres in one another", "overlap by 1.6 of"});
  refuse_file(lattice(1e-3, {1, 2, 3, 4, 5, 6, 7, 8, 9}),
              {"crushed.prm:", "Specimen/End layer = 0.5 leaves a platen without a sphere",
               "lies 0.002 m from", "the bottom one", "0.0005 m deep"});
  fs::remove(folder_ / "spheres.csv");
  refuse({{"bad.prm"}, {"bad.prm:4: error: Specimen/File = spheres.csv cannot be read"}});
}

TEST_F(Errors, platens_that_cannot_be_meshed_are_refused_by_key_or_file) {
  // A cube of 30 units, of 12; one whose upper side slants, so that as a top platen it cannot be held.
  const auto cube = [](double half, double slant = 0) {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
    int node = 0;
    for (const double z : {0.0, 10.0})
      for (const auto &[x, y] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}})
        text += fmt::format("{} {} {} {}\n", ++node, x, y, z + (z > 0 && x > 0 ? slant : 0));
    return text + "$EndNodes\n$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n";
  };
  put(folder_ / "wide.msh", cube(15));
  put(folder_ / "narrow.msh", cube(6));
  put(folder_ / "slant.msh", cube(15, 2));
  put(folder_ / "bad.msh", "$Mess\n");
  const std::string all_of_it = "Platens/Mesh unit = 1 mm", wide = "Platens/Top/Mesh file = wide.msh",
                    narrow = "Platens/Top/Mesh file = narrow.msh";
  for (const auto &[entries, says] : std::vector<std::pair<Words, Words>>{
           {{"Platens/Kind = deformable", "Platens/Elements across = 2"},
            {"--set 2: error: Platens/Elements across = 2", "at least 3"}},
           {{"Platens/Top/Mesh file = nowhere.msh"},
            {"--set 1: error: Platens/Top/Mesh file = nowhere.msh cannot be read"}},
           {{narrow, all_of_it}, // a square of 12 in a circle of 20 mm
            {"--set 1: error: Platens/Top/Mesh file = narrow.msh faces the specimen with 0.012 m x 0.012 m",
             "46 % of its end", "Platens/Cover = partial"}},
           {{wide, "Platens/Mesh unit = 1 m"},
            {"wide.msh is 30 m x 30 m wide where the specimen has 0.02 m: is it in another unit?"}},
           {{"Platens/Top/Mesh file = bad.msh"}, {"bad.msh:1: error: \"$Mess\" where $MeshFormat is due"}},
           {{all_of_it, "Platens/Top/Mesh file = slant.msh"},
            {"--set 2: error: Platens/Top/Mesh file = slant.msh has no face", "nothing to hold"}}})
    refuse_entries(entries, says);
  for (const auto &[entries, says] : std::vector<std::pair<Words, std::string>>{
           {{wide, all_of_it}, "top 30 mm x 30 mm, facing 1.00"},
           {{narrow, all_of_it, "Platens/Cover = partial"}, "top 12 mm x 12 mm, facing 0.46"}}) {
    const Outcome outcome = run(entries, {"--dry-run"});
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_TRUE(contains(outcome.out, says));
  }
}

// An id that no sphere has: at the start, and where the list has changed before a run goes on.
TEST_F(Errors, ids_beyond_the_spheres_are_refused_and_on_resume_any_change_of_them) {
  const Words listed{"Phases/By = file", "Phases/File = " + (folder_ / "ids.txt").string()};
  put(folder_ / "ids.txt", "# large\n0\n1\n99999\n");
  refuse_entries(listed, {"ids.txt:4: error: names sphere 99999, but the specimen has ", "Allowed: 0 ... 1"});
  put(folder_ / "ids.txt", "0\n1\n2\n");
  ASSERT_EQ(stop_at("results", 3, SIGTERM, listed, {"-t", "1"}), 143);
  put(folder_ / "ids.txt", "0\n1\n\n99999\n");
  refuse_entries(listed,
                 {"--set 2: error: Phases/File = ", "names a file that has changed since the run began"},
                 {"--resume"});
}

TEST_F(Errors, a_dry_run_tells_what_would_run_and_writes_nothing) {
  put(folder_ / "out.txt", "");
  put(folder_ / "error.txt", "");
  const Words before = names();
  const Outcome outcome = run({}, {"--dry-run"});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  for (const char *part :
       {"particles ", "bonds ", "effects on:  parallel bond, linear contact", "effects off: hertz contact",
        "time step ", "2/omega", "steps to the target strain", "estimate: ", "ms a step", "memory "})
    EXPECT_TRUE(contains(outcome.out, part));
  EXPECT_EQ(names(), before);
}

TEST_F(Errors, printed_parameters_are_a_scene_again) {
  // As .prm and as JSON; what the print of either prints is the same text: nothing is lost on the way.
  const Words options{"--print-parameters", "-s", "Bond/Modulus = 12.345678901234567 GPa"};
  for (const bool json : {false, true}) {
    Words first{scene_}, second{json ? "printed.json" : "printed.prm", "--print-parameters"};
    first.insert(first.end(), options.begin(), options.end());
    if (json) first.push_back("--json"), second.push_back("--json");
    const Outcome once = run_compress(first, folder_);
    ASSERT_EQ(once.status, 0) << once.error;
    EXPECT_TRUE(contains(once.out, "12.345678901234567 GPa"));
    put(folder_ / second.front(), once.out);
    const Outcome again = run_compress(second, folder_);
    EXPECT_EQ(again.status, 0) << again.error;
    EXPECT_EQ(again.out, once.out);
    const Outcome runs = run_compress({second.front(), "--dry-run"}, folder_);
    EXPECT_EQ(runs.status, 0) << runs.error;
  }
}

} // namespace
} // namespace platen::apps::testing
