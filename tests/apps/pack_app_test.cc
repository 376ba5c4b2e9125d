// platen-pack: every kind of packing from a scene to the output folder, and back in from its file.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

#include "apps/output/specimen_csv.h"
#include "apps/programs.h"
#include "apps/run/pack.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/errors.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;
using Words = std::vector<std::string>;

constexpr const char *cylinder =
    "subsection Specimen\n"
    "  set Shape = cylinder\n"
    "  set Radius = 8 mm\n"
    "  set Height = 20 mm\n"
    "  set Sphere radius = 1 mm\n"
    "end\n";

// Some 2 300 spheres.
constexpr const char *large_box =
    "subsection Specimen\n"
    "  set Shape = box\n"
    "  set Width x = 24 mm\n"
    "  set Width y = 24 mm\n"
    "  set Height = 30 mm\n"
    "  set Sphere radius = 1 mm\n"
    "  set Packing = random close\n"
    "end\n";

class PackApp : public ScratchFolder {
protected:
  PackApp() { write("small.prm", cylinder); }

  void write(const std::string &name, const std::string &text) const { put(folder_ / name, text); }
  Scene scene(const std::string &name, const Words &overrides = {}) const {
    return read_scene((folder_ / name).string(), overrides, program("pack"));
  }
  int run(const Scene &of, const std::string &to) const {
    CommandLine command;
    command.scene = of.path;
    command.output = (folder_ / to).string();
    command.quiet = true;
    return run_pack(command, of);
  }
  nlohmann::json summary(const std::string &of) const {
    return nlohmann::json::parse(content_of(folder_ / of / "summary.json"));
  }

  struct Direction {
    double x = 0, y = 0, z = 0, weight = 0, contacts = 0, share = 0;
  };
  std::vector<Direction> directions(const std::string &of) const {
    std::ifstream file(folder_ / of / "directions.csv");
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "x,y,z,share_of_directions,contacts,share_of_contacts");
    std::vector<Direction> rows;
    while (std::getline(file, line)) {
      Direction d;
      EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &d.x, &d.y, &d.z, &d.weight, &d.contacts,
                            &d.share),
                6);
      rows.push_back(d);
    }
    return rows;
  }
};

// The scenes of crushed specimens are packed too: what only their test can measure is told and left to it.
TEST_F(PackApp, checks_the_numbers_that_are_its_own) {
  const Words ends{"Expect/strength_pa = 1 MPa ... 2 MPa", "Expect/cone_top/height_m = ... 1 mm"};
  EXPECT_EQ(run(scene("small.prm", ends), "others"), status_done);
  EXPECT_TRUE(
      contains(content_of(folder_ / "others/run.log"), "not checked here: strength_pa, cone_top/height_m"));
  EXPECT_EQ(run(scene("small.prm", {"Expect/packing_fraction = 0.3 ... 0.6"}), "own"), status_done);
  EXPECT_EQ(run(scene("small.prm", {"Expect/packing_fraction = 0.7 ..."}), "missed"), status_check_failed);
  EXPECT_EQ(summary("own")["expectations"][0]["met"], true);
  EXPECT_EQ(summary("others")["expectations"][0]["met"], nullptr);
  const auto missed = summary("missed")["expectations"][0];
  EXPECT_EQ(missed["entry"], "Expect/packing_fraction");
  EXPECT_EQ(missed["range"], "0.7 ...");
  EXPECT_EQ(missed["value"], summary("missed")["packing_fraction"]);
  EXPECT_EQ(missed["met"], false);
}

TEST_F(PackApp, judges_what_it_packs) {
  ASSERT_EQ(run(scene("small.prm"), "a"), status_done);
  for (const char *name :
       {"specimen.csv", "specimen.vtu", "directions.csv", "summary.json", "scene.prm", "run.log"})
    EXPECT_TRUE(fs::exists(folder_ / "a" / name)) << name;
  const nlohmann::json s = summary("a");
  const dem::Specimen written = read_specimen_csv(folder_ / "a/specimen.csv").specimen;
  EXPECT_EQ(s["particles"], written.size());
  const double fraction = dem::volume_of_spheres(written) / written.shape.volume();
  EXPECT_NEAR(s["packing_fraction"].get<double>(), fraction, 1e-12);
  // Each sphere of the front touches three earlier ones: 3 N - 6 contacts.
  const double n = static_cast<double>(written.size());
  EXPECT_NEAR(s["coordination_number"].get<double>(), 2 * (3 * n - 6) / n, .02);
}

// Ten spheres in a row: nine contacts with one direction, in a cell less than 10 degrees across.
TEST_F(PackApp, tells_where_contacts_point) {
  const double step[] = {2e-3 / std::sqrt(14.0), 4e-3 / std::sqrt(14.0), 6e-3 / std::sqrt(14.0)};
  std::ostringstream spheres;
  spheres << "x_m,y_m,z_m,radius_m\n" << std::setprecision(17);
  for (int k = 0; k < 10; ++k)
    spheres << k * step[0] << ',' << k * step[1] << ',' << 0.02 + k * step[2] << ",0.001\n";
  write("row.csv", spheres.str());
  write("row.prm",
        "subsection Specimen\n  set Shape = box\n  set Width x = 60 mm\n  set Width y = 60 mm\n"
        "  set Height = 60 mm\n  set Packing = file\n  set File = row.csv\nend\n");
  ASSERT_EQ(run(scene("row.prm"), "row"), status_done);
  double contacts = 0;
  for (const Direction &d : directions("row")) {
    contacts += d.contacts;
    EXPECT_EQ(d.share, d.contacts / 9);
    if (d.contacts == 0) continue;
    EXPECT_GT((d.x * step[0] + d.y * step[1] + d.z * step[2]) / 2e-3, std::cos(0.17));
  }
  EXPECT_EQ(contacts, 9);
}

// Chi squared of the table, from its definition, is the figure of the summary.
TEST_F(PackApp, judges_isotropy_by_the_directions_that_it_tells) {
  ASSERT_EQ(run(scene("small.prm"), "a"), status_done);
  const std::vector<Direction> table = directions("a");
  ASSERT_EQ(table.size(), 160u);
  double whole = 0, contacts = 0, sum = 0;
  for (const Direction &d : table) {
    whole += d.weight, contacts += d.contacts;
    sum += (d.share - d.weight) * (d.share - d.weight) / d.weight;
  }
  EXPECT_NEAR(whole, 1, 1e-12);
  EXPECT_GT(contacts, 100);
  EXPECT_NEAR(summary("a")["isotropy_chi_squared"].get<double>(), contacts * sum / 159, 1e-9);
}

// The figure of the summary is a double written with all its digits.
TEST_F(PackApp, tells_how_heavy_grains_make_a_solid) {
  const Scene solid = scene("small.prm", {"Material/Density = 2201", "Material/Density of = solid"});
  ASSERT_EQ(run(solid, "solid"), status_done);
  ASSERT_EQ(run(scene("small.prm", {"Material/Density = 2201"}), "grains"), status_done);
  EXPECT_EQ(summary("grains")["grain_density_kg_m3"], 2201);
  EXPECT_NEAR(summary("solid")["grain_density_kg_m3"].get<double>() *
                  summary("solid")["packing_fraction"].get<double>(),
              2201, 2201e-12);
}

TEST_F(PackApp, a_dry_run_refuses_spheres_without_number) {
  CommandLine command;
  command.output = (folder_ / "dry").string();
  command.dry_run = true;
  const Scene tiny = scene("small.prm", {"Specimen/Sphere radius = 1 nm"});
  EXPECT_TRUE(contains(message_of<InputError>([&] { run_pack(command, tiny); }),
                       "Specimen/Sphere radius = 1 nm is too small: "));
}

TEST_F(PackApp, phases_have_to_fit_the_spheres) {
  const auto refusal = [&](const Words &overrides) -> std::string {
    try {
      make_specimen(scene("small.prm", overrides));
    } catch (const InputError &error) {
      return error.what();
    }
    return "";
  };
  const auto listed = [&](const std::string &ids) {
    write("ids.txt", ids);
    return refusal({"Phases/By = file", "Phases/File = " + (folder_ / "ids.txt").string()});
  };
  const std::size_t spheres = make_specimen(scene("small.prm")).size();
  const std::string last = std::to_string(spheres - 1), count = std::to_string(spheres);
  EXPECT_EQ(listed("0\n" + last + "\n"), "");
  EXPECT_TRUE(contains(listed("0\n" + count + "\n"), "names sphere " + count));
  EXPECT_TRUE(contains(listed("0\n" + count + "\n"), "Allowed: 0 ... " + last));
  EXPECT_TRUE(contains(listed("# none\n"), "names no sphere"));
  EXPECT_TRUE(contains(listed("1\nx\n"), "ids.txt:2: error"));
  // All radii are 1 mm.
  for (const char *radius : {"0.9 mm", "1.1 mm"})
    EXPECT_TRUE(contains(refusal({"Phases/By = radius", std::string("Phases/Radius above = ") + radius}),
                         "leaves one phase empty"))
        << radius;
  EXPECT_EQ(refusal({"Phases/By = radius", "Phases/Radius above = 1 mm", "Specimen/Radius spread = 0.2"}),
            "");
}

TEST_F(PackApp, the_same_seed_gives_the_same_file) {
  ASSERT_EQ(run(scene("small.prm"), "a"), status_done);
  ASSERT_EQ(run(scene("small.prm"), "b"), status_done);
  ASSERT_EQ(run(scene("small.prm", {"Scene/Seed = 2"}), "c"), status_done);
  EXPECT_EQ(content_of(folder_ / "a/specimen.csv"), content_of(folder_ / "b/specimen.csv"));
  EXPECT_NE(content_of(folder_ / "a/specimen.csv"), content_of(folder_ / "c/specimen.csv"));
}

// A packing that is read back is the packing that was written, bit for bit, shape included.
TEST_F(PackApp, a_written_packing_is_read_back) {
  ASSERT_EQ(
      run(scene("small.prm", {"Specimen/Packing = random close", "Specimen/Radius spread = 0.25"}), "a"),
      status_done);
  write("again.prm", "subsection Specimen\n  set Packing = file\n  set File = a/specimen.csv\nend\n");
  ASSERT_EQ(run(scene("again.prm"), "b"), status_done);
  EXPECT_EQ(content_of(folder_ / "a/specimen.csv"), content_of(folder_ / "b/specimen.csv"));
  // Jammed against flat ends: about .6 with its walls, and many spheres on each platen.
  const nlohmann::json s = summary("b");
  EXPECT_GT(s["packing_fraction"].get<double>(), .54);
  EXPECT_GT(s["touching_bottom"].get<int>(), 15);
  EXPECT_GT(s["touching_top"].get<int>(), 15);
}

TEST_F(PackApp, lays_a_large_packing_out_of_tiles_and_tells_how_many) {
  write("large.prm", large_box);
  ASSERT_EQ(run(scene("large.prm", {"Specimen/Tile spheres = 400"}), "tiled"), status_done);
  ASSERT_EQ(run(scene("large.prm"), "whole"), status_done);
  const nlohmann::json tiled = summary("tiled"), whole = summary("whole");
  EXPECT_FALSE(whole.contains("tiles"));
  const double period = tiled["tile_period_m"].get<double>();
  EXPECT_NEAR(tiled["tiles"].get<double>() * period * period * period, 24e-3 * 24e-3 * 30e-3, 1e-10);
  EXPECT_NEAR(tiled["tiles"].get<double>(), tiled["particles"].get<double>() / 400, .5); // less at walls
  for (const char *key : {"packing_fraction", "core_packing_fraction"})
    EXPECT_NEAR(tiled[key].get<double>(), whole[key].get<double>(), .01) << key;
  EXPECT_NE(content_of(folder_ / "tiled/specimen.csv"), content_of(folder_ / "whole/specimen.csv"));
  EXPECT_TRUE(contains(content_of(folder_ / "tiled/run.log"), "the same again every"));
}

TEST_F(PackApp, refuses_tiles_that_are_no_small_part_of_the_specimen) {
  write("large.prm", large_box);
  const auto said = [&](const std::string &entry, bool dry) {
    const Scene large = scene("large.prm", {entry});
    return message_of<InputError>(
        [&] { dry ? static_cast<void>(require_room(large)) : static_cast<void>(make_specimen(large)); });
  };
  for (const bool dry : {false, true}) {
    EXPECT_TRUE(contains(said("Specimen/Tile spheres = 1500", dry), "Allowed: 200 ... 1300, or 0"));
    EXPECT_TRUE(contains(said("Specimen/Tile spheres = 199", dry), "would meet itself"));
  }
}

TEST_F(PackApp, packs_boxes_and_bars) {
  write("box.prm",
        "subsection Specimen\n  set Shape = box\n  set Width x = 12 mm\n  set Width y = 9 mm\n"
        "  set Height = 15 mm\n  set Sphere radius = 1 mm\nend\n");
  const dem::Specimen box = make_specimen(scene("box.prm"));
  EXPECT_EQ(box.shape.kind, dem::ShapeKind::box);
  EXPECT_DOUBLE_EQ(box.shape.width_y, 9e-3);
  EXPECT_TRUE(dem::check_specimen(box).empty());
  const dem::Specimen bar =
      make_specimen(scene("box.prm", {"Specimen/Shape = bar", "Specimen/Height = 40 mm"}));
  EXPECT_EQ(bar.shape.kind, dem::ShapeKind::box);
  EXPECT_TRUE(dem::check_specimen(bar).empty());
  const dem::Specimen round = make_specimen(scene("small.prm", {"Specimen/Shape = bar"}));
  EXPECT_EQ(round.shape.kind, dem::ShapeKind::cylinder);
}

TEST_F(PackApp, radii_follow_their_distribution) {
  const Words uniform{"Specimen/Radius spread = 0.4"};
  const Words two{"Specimen/Radius distribution = two sizes", "Specimen/Second radius ratio = 0.6",
                  "Specimen/Second fraction = 0.3"};
  const dem::Specimen u = make_specimen(scene("small.prm", uniform)),
                      t = make_specimen(scene("small.prm", two));
  EXPECT_NEAR(dem::mean_radius(u), 1e-3, .02e-3);
  EXPECT_GE(dem::smallest_radius(u), .8e-3);
  EXPECT_LE(dem::largest_radius(u), 1.2e-3);
  // Mean 1 mm, ratio .6, three in ten small: large = 1/(1 - .3 x .4) mm.
  const double large = 1e-3 / .88;
  std::size_t small_ones = 0;
  for (const double r : t.radius) {
    EXPECT_TRUE(std::abs(r - large) < 1e-12 || std::abs(r - .6 * large) < 1e-12) << r;
    small_ones += r < .8 * large;
  }
  EXPECT_NEAR(static_cast<double>(small_ones) / static_cast<double>(t.size()), .3, .1);
  EXPECT_EQ(dem::smallest_radius(make_specimen(scene("small.prm"))), 1e-3);
}

TEST_F(PackApp, a_file_that_contradicts_the_scene_is_refused) {
  ASSERT_EQ(run(scene("small.prm"), "a"), status_done);
  const std::string file = "subsection Specimen\n  set Packing = file\n  set File = a/specimen.csv\n";
  const auto refused = [&](const std::string &lines) {
    write("wrong.prm", file + lines + "end\n");
    EXPECT_THROW(run(scene("wrong.prm"), "x"), InputError) << lines;
    EXPECT_FALSE(fs::exists(folder_ / "x")) << lines;
  };
  refused("  set Radius = 7 mm\n");
  refused("  set Height = 20.1 mm\n");
  refused("  set Shape = box\n  set Width x = 16 mm\n  set Width y = 16 mm\n");
  write("agrees.prm", file + "  set Radius = 8 mm\n  set Height = 20 mm\nend\n");
  EXPECT_EQ(run(scene("agrees.prm"), "b"), status_done);
}

TEST_F(PackApp, an_unsound_file_is_refused) {
  const auto refused = [&](const std::string &rows) {
    write("spheres.csv", "# shape: cylinder radius_m=0.01 height_m=0.02\nx_m,y_m,z_m,radius_m\n" + rows);
    write("wrong.prm", "subsection Specimen\n  set Packing = file\n  set File = spheres.csv\nend\n");
    EXPECT_THROW(run(scene("wrong.prm"), "x"), InputError) << rows;
    EXPECT_FALSE(fs::exists(folder_ / "x")) << rows;
  };
  refused("0,0,0.01,0.001\n0,0,0.01,0.001\n"); // one centre
  refused("0,0,0.0005,0.001\n");               // out of the bottom
  refused("0.0095,0,0.01,0.001\n");            // out of the side
  refused("0,0,0.01,-0.001\n");                // no radius
  refused("");                                 // no sphere
}

TEST_F(PackApp, a_file_without_a_shape_takes_that_of_the_scene) {
  write("spheres.csv", "x_m,y_m,z_m,radius_m\n0,0,0.01,0.001\n0.002,0,0.01,0.001\n");
  const std::string file = "subsection Specimen\n  set Packing = file\n  set File = spheres.csv\n";
  write("shapeless.prm", file + "  set Height = 20 mm\nend\n");
  EXPECT_TRUE(contains(message_of<InputError>([&] { make_specimen(scene("shapeless.prm")); }),
                       "states no shape: the scene has to give Specimen/Height and Radius"));
  write("shaped.prm", file + "  set Radius = 8 mm\n  set Height = 20 mm\nend\n");
  EXPECT_DOUBLE_EQ(make_specimen(scene("shaped.prm")).shape.radius, 8e-3);
}

// Neither file nor scene has a length: a box, or the cylinder that the scene asks for.
TEST_F(PackApp, a_shape_that_nobody_states_is_what_the_spheres_reach) {
  write("spheres.csv", "x_mm;y_mm;z_mm;radius_mm\n1,5;2;3;1\n4,5;2;3;1\n");
  write("shapeless.prm", "subsection Specimen\n  set Packing = file\n  set File = spheres.csv\nend\n");
  const Scene box = scene("shapeless.prm"), round = scene("shapeless.prm", {"Specimen/Shape = cylinder"});
  EXPECT_EQ(box.specimen.shape, SpecimenShape::box);
  EXPECT_NEAR(box.specimen.width_x, 5e-3, 1e-15);
  ASSERT_EQ(box.notes.size(), 3u);
  EXPECT_TRUE(
      contains(box.notes[0],
               "shapeless.prm:3: note: Specimen/File = spheres.csv, commas in numbers are decimal signs."));
  EXPECT_TRUE(contains(box.notes[1], "a box of 5 x 2 x 2 mm"));
  EXPECT_TRUE(contains(box.notes[2], "moved by -3, -2, -2 mm"));
  const dem::Specimen in_box = make_specimen(box), in_cylinder = make_specimen(round);
  EXPECT_NEAR(in_box.centre[0].x, -1.5e-3, 1e-15);
  EXPECT_NEAR(in_box.centre[1].z, 1e-3, 1e-15);
  EXPECT_EQ(in_cylinder.shape.kind, dem::ShapeKind::cylinder);
  EXPECT_NEAR(in_cylinder.shape.radius, 2.5e-3, 1e-15);
  EXPECT_EQ(round.specimen.radius, in_cylinder.shape.radius);
  ASSERT_EQ(run(box, "moved"), status_done);
  // The scene that is written asks for the same box.
  EXPECT_EQ(scene("moved/scene.prm").specimen.shape, SpecimenShape::box);
  write("again.prm", "subsection Specimen\n  set Packing = file\n  set File = moved/specimen.csv\nend\n");
  EXPECT_TRUE(scene("again.prm").notes.empty());
}

TEST_F(PackApp, what_it_exports_is_read_back_to_the_same_bytes) {
  ASSERT_EQ(run(scene("small.prm", {"Specimen/Export = lammps dump, yade, lammps data"}), "a"), status_done);
  const std::string packed = content_of(folder_ / "a/specimen.csv");
  for (const std::string file : {"specimen.yade.txt", "specimen.data", "specimen.dump"}) {
    const Scene again =
        scene("small.prm", {"Specimen/Packing = file", "Specimen/File = " + (folder_ / "a" / file).string()});
    EXPECT_TRUE(again.notes.empty()) << again.notes.front();
    ASSERT_EQ(run(again, file), status_done);
    EXPECT_EQ(content_of(folder_ / file / "specimen.csv"), packed) << file;
    EXPECT_FALSE(fs::exists(folder_ / file / "specimen.dump"));
  }
  EXPECT_THROW(scene("small.prm", {"Specimen/Export = columns"}), InputError);
}

TEST_F(PackApp, the_scene_says_how_a_file_lists_its_spheres) {
  write("bare.txt", "0 0 10 2\n2 0 10 2\n");
  const Words file{"Specimen/Packing = file", "Specimen/File = " + (folder_ / "bare.txt").string()};
  const auto with = [&](const Words &more) {
    Words all = file;
    all.insert(all.end(), more.begin(), more.end());
    return scene("small.prm", all);
  };
  const dem::Specimen bare = make_specimen(with({"Specimen/File columns = x_mm, y_mm, z_mm, diameter_mm"}));
  EXPECT_EQ(bare.centre[1].x, 0.002);
  EXPECT_EQ(bare.radius[1], 0.001);
  EXPECT_TRUE(contains(message_of<InputError>([&] { with({}); }),
                       "bare.txt:1: error: \"0 0 10 2\" is not the header"));
  EXPECT_TRUE(contains(message_of<InputError>([&] { with({"Specimen/File format = lammps data"}); }),
                       "bare.txt: error: lists no atoms"));
  write("bare.txt", "0 0 .01 .001\n.002 0 .01 .001\n");
  EXPECT_EQ(make_specimen(with({"Specimen/File format = yade"})).centre[1].x, 0.002);
}

TEST_F(PackApp, what_no_packer_can_do_is_refused) {
  EXPECT_THROW(make_specimen(scene("small.prm", {"Specimen/Packing = random close",
                                                 "Specimen/Radius distribution = two sizes"})),
               InputError);
}

} // namespace
} // namespace platen::apps
