#include <set>

#include "apps/output/output_folder.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class OutputFolder : public ScratchFolder {
protected:
  fs::path output_ = folder_ / "results" / "case one";
  std::set<std::string> all() const {
    std::set<std::string> names;
    for (const auto &file : fs::recursive_directory_iterator(output_))
      names.insert(file.path().lexically_relative(output_).string());
    return names;
  }
  // One file under every name that the apps write, taken from what names them.
  void write_run() const {
    const OutputPaths paths(output_);
    for (const fs::path &file : {paths.scene(),
                                 paths.history(),
                                 paths.cracks(),
                                 paths.summary(),
                                 paths.log(),
                                 paths.specimen_csv(),
                                 paths.specimen_vtu(),
                                 paths.directions(),
                                 paths.study(),
                                 paths.study_json(),
                                 paths.costs(),
                                 paths.view(),
                                 output_ / "fields.pvd",
                                 output_ / "frames" / "fields_000003.vti",
                                 paths.checkpoints() / "step_000000000007.platen",
                                 paths.checkpoints() / "step_000000000008.part.platen",
                                 paths.plan(),
                                 paths.plan_json(),
                                 paths.run_record("grease_seed_1"),
                                 paths.runs() / "grease_seed_2.run.part.json",
                                 paths.packings() / "0123456789abcdef.csv",
                                 paths.packings() / "0123456789abcdef.node-3_42.part.csv",
                                 paths.packings() / "in_use"})
      put(file, "run");
    for (const char *series : {"specimen", "bonds", "platens", "sleeve", "contacts"}) {
      put(output_ / (std::string(series) + ".pvd"), "run");
      put(paths.folder / OutputPaths::frame_name(series, 0), "run");
      put(paths.folder / OutputPaths::frame_name(series, 1234567), "run");
    }
    put(output_ / "summary.part.json", "killed while writing");
    put(output_ / "frames" / "bonds_000003.part.vtu", "killed while writing");
    for (const char *of_pieces : {"specimen_000001.pvtu", "bonds_000001.part.pvtu", "bonds_000001_0000.vtu",
                                  "specimen_000001_12345.part.vtu"})
      put(output_ / "frames" / of_pieces, "run");
  }
};

TEST_F(OutputFolder, numbers_its_frames) {
  EXPECT_EQ(OutputPaths::frame_name("bonds", 12), "frames/bonds_000012.vtu");
}

TEST_F(OutputFolder, is_created_with_its_parents) {
  open_output_folder(output_, FolderUse::fresh);
  EXPECT_TRUE(fs::is_directory(output_));
}

TEST_F(OutputFolder, is_not_created_by_a_check) {
  check_output_folder(output_, FolderUse::fresh);
  EXPECT_FALSE(fs::exists(output_.parent_path()));
}

TEST_F(OutputFolder, with_files_of_the_user_alone_is_taken) {
  put(output_ / "notes.txt", "mine");
  put(output_ / "pictures" / "curve.png", "mine");
  open_output_folder(output_, FolderUse::fresh);
  EXPECT_EQ(content_of(output_ / "notes.txt"), "mine");
}

// As a run leaves it that was killed before it wrote anything.
TEST_F(OutputFolder, with_an_empty_log_alone_is_taken) {
  put(output_ / "run.log", "");
  EXPECT_NO_THROW(open_output_folder(output_, FolderUse::fresh));
  put(output_ / "history.csv", "");
  EXPECT_THROW(open_output_folder(output_, FolderUse::fresh), FolderError);
}

TEST_F(OutputFolder, with_anything_of_an_earlier_run_is_refused_with_advice) {
  for (const char *name : {"summary.json", "history.csv", "scene.prm", "checkpoint/step_000000000001.platen",
                           "frames/specimen_000000.vtu", "bonds.pvd", "run.log"}) {
    fs::remove_all(output_);
    put(output_ / name, "run");
    const std::string text = message_of<FolderError>([&] { open_output_folder(output_, FolderUse::fresh); });
    EXPECT_TRUE(contains(text, output_.string()) && contains(text, name) && contains(text, "--overwrite") &&
                contains(text, "--resume") && contains(text, "--output"))
        << text;
    EXPECT_EQ(content_of(output_ / name), "run");
  }
}

TEST_F(OutputFolder, overwritten_loses_what_the_run_wrote_and_nothing_else) {
  const std::set<std::string> mine{"notes.txt",
                                   "history.csv.bak",
                                   "old history.csv",
                                   "scene2.prm",
                                   "checkpoint/step_7.platen",
                                   "checkpoint/notes.txt",
                                   "checkpoint/history.csv",
                                   "mesh/platens.pvd",
                                   "rock_000001.vtu",
                                   "frames/platens_000001.pvtu",
                                   "frames/specimen_000001_7.vtu",
                                   "specimen_000001.vtu"};
  write_run();
  for (const std::string &name : mine)
    put(output_ / name, "mine");
  open_output_folder(output_, FolderUse::overwrite);
  std::set<std::string> expected = mine;
  expected.insert({"checkpoint", "frames", "mesh", "run.log"});
  EXPECT_EQ(all(), expected);
  for (const std::string &name : mine)
    EXPECT_EQ(content_of(output_ / name), "mine");
  EXPECT_EQ(content_of(output_ / "run.log"), ""); // the file by which it is held
}

TEST_F(OutputFolder, overwritten_takes_links_but_not_what_they_lead_to) {
  put(folder_ / "precious.csv", "mine");
  fs::create_directories(output_);
  fs::create_symlink(folder_ / "precious.csv", output_ / "history.csv");
  open_output_folder(output_, FolderUse::overwrite);
  EXPECT_TRUE(all().empty());
  EXPECT_EQ(content_of(folder_ / "precious.csv"), "mine");
}

TEST_F(OutputFolder, with_a_folder_under_the_name_of_a_file_is_refused) {
  put(output_ / "history.csv" / "inside.txt", "mine");
  EXPECT_THROW(open_output_folder(output_, FolderUse::overwrite), FolderError);
  EXPECT_EQ(content_of(output_ / "history.csv" / "inside.txt"), "mine");
}

TEST_F(OutputFolder, never_replaces_what_the_run_reads) {
  put(output_ / "scene.prm", "my scene");
  put(output_ / "specimen.csv", "my spheres");
  for (const FolderUse use : {FolderUse::fresh, FolderUse::overwrite}) {
    for (const fs::path &input :
         {output_ / "scene.prm", output_ / ".." / "case one" / "scene.prm", output_ / "specimen.csv"}) {
      const std::string text = message_of<FolderError>([&] { open_output_folder(output_, use, {input}); });
      EXPECT_TRUE(contains(text, input.string()));
    }
  }
  EXPECT_EQ(content_of(output_ / "scene.prm"), "my scene");
  EXPECT_EQ(content_of(output_ / "specimen.csv"), "my spheres");
  // A scene elsewhere of the same name is no hindrance.
  put(folder_ / "scene.prm", "another");
  EXPECT_NO_THROW(check_output_folder(output_, FolderUse::overwrite, {folder_ / "scene.prm"}));
}

TEST_F(OutputFolder, is_resumed_only_where_a_checkpoint_is) {
  EXPECT_TRUE(contains(message_of<FolderError>([&] { open_output_folder(output_, FolderUse::resume); }),
                       "no checkpoint"));
  EXPECT_FALSE(fs::exists(output_));
  put(output_ / "history.csv", "run");
  EXPECT_THROW(open_output_folder(output_, FolderUse::resume), FolderError);
  write_run();
  const std::set<std::string> before = all();
  open_output_folder(output_, FolderUse::resume, {output_ / "scene.prm"});
  EXPECT_EQ(all(), before);
}

TEST_F(OutputFolder, that_cannot_be_is_refused) {
  put(folder_ / "file", "");
  for (const fs::path &place :
       {folder_ / "file", folder_ / "file" / "below", fs::path("/proc/no such place")}) {
    const std::string text = message_of<FolderError>([&] { open_output_folder(place, FolderUse::fresh); });
    EXPECT_TRUE(contains(text, place.string()));
  }
}

} // namespace
} // namespace platen::apps
