// The specimen, its grains, and which effects act between them.
#include <stdexcept>

#include "apps/scene/flaws.h"
#include "apps/scene/members.h"
#include "apps/scene/sections.h"
#include "apps/scene/specimen_formats.h"
#include "dem/laws/normal_contact.h"

namespace platen::apps {
namespace {

Words<SpecimenFormat> words_of_formats() {
  Words<SpecimenFormat> words;
  for (const SpecimenFormatRule &rule : specimen_formats())
    words.insert(words.begin(), {rule.word, rule.format});
  return words;
}

std::vector<std::string> names_of_exports() {
  std::vector<std::string> names;
  for (const auto &[word, format] : words_of_formats())
    if (format != SpecimenFormat::columns) names.push_back(word);
  return names;
}

std::vector<SpecimenFormat> read_exports(const std::string &text) {
  const std::vector<std::string> names = names_of_exports();
  return read_items<SpecimenFormat>(text, [&](const std::string &item) {
    const std::string &name = names[read_word(item, names)];
    for (const SpecimenFormatRule &rule : specimen_formats())
      if (rule.word == name) return rule.format;
    throw std::logic_error("a format without a rule");
  });
}

void declare_flaws(Parameters &parameters, SpecimenSection &specimen) {
  parameters.declare_series(
      "Specimen/Flaw 1", specimen.flaws.size(), [&specimen](Parameters &to, std::size_t number) {
        const std::string key = "Flaw " + std::to_string(number);
        Section(to, "Specimen")
            .unless("Effects/Bond", {"none"})
            .value(key, specimen.flaws[number - 1], "", flaw_allowed, read_flaw,
                   "A crack or weak plane that is there before the test, in the coordinates of the specimen "
                   "between "
                   "its platens: bonds whose line between centres passes through it are cut, or both their "
                   "strengths "
                   "times the factor. Of a rectangle the first width is the horizontal one.");
      });
}

} // namespace

void declare_specimen(Parameters &parameters, SpecimenSection &specimen) {
  Section section(parameters, "Specimen");
  section.entry<SpecimenShape>(
      "Shape", specimen.shape,
      {{"cylinder", SpecimenShape::cylinder},
       {"box", SpecimenShape::box},
       {"bar", SpecimenShape::bar},
       {"disc", SpecimenShape::disc}},
      "Shape of the specimen; its axis is z. A bar is round (Radius) or rectangular; a disc (Radius, Height) "
      "is laid on its rim by platen-brazilian. Test = three point bending bends a box that is long along x, "
      "or lays a rectangular bar down along x with its x up.");
  section.entry("Radius", specimen.radius, "m", above(0), "Radius of a cylinder or round bar.");
  section.entry("Height", specimen.height, "m", above(0), "Extent along z.");
  section.entry("Width x", specimen.width_x, "m", above(0), "Width of a box or rectangular bar along x.");
  section.entry("Width y", specimen.width_y, "m", above(0), "Width of a box or rectangular bar along y.");
  section.entry("Sphere radius", specimen.sphere_radius, "m", above(0), "Mean radius of the spheres.")
      .member("specimen.radius");
  section.number("Radius spread", specimen.radius_spread, between(0, 1.5),
                 "Kappa, largest minus smallest radius over the mean (Radius distribution = uniform).");
  section.entry<RadiusKind>(
      "Radius distribution", specimen.radius_distribution,
      {{"equal", RadiusKind::equal}, {"two sizes", RadiusKind::two_sizes}, {"uniform", RadiusKind::uniform}},
      "How radii are drawn; uniform with a spread of 0 is equal spheres.");
  Section two_sizes = section.only_if("Specimen/Radius distribution", {"two sizes"});
  two_sizes.number("Second radius ratio", specimen.second_radius_ratio, above_up_to(0, 1),
                   "Smaller radius over the larger one.");
  two_sizes.number("Second fraction", specimen.second_fraction, between(0, 1),
                   "Share of the number of spheres that has the smaller radius.");
  section.entry<PackingKind>("Packing", specimen.packing,
                             {{"advancing front", PackingKind::advancing_front},
                              {"random close", PackingKind::random_close},
                              {"file", PackingKind::file}},
                             "How the spheres are placed; file takes them from File.");
  section
      .integer("Tile spheres", specimen.tile_spheres, 0, 5000000,
               "A large packing is laid out of copies of one of so many spheres, which repeats itself "
               "without seams, and grown on between the walls; 0 grows it as a whole. What is told of many "
               "tiles is known of one.")
      .only_if("Specimen/Packing", {"random close"});
  Section read = section.only_if("Specimen/Packing", {"file"});
  read.file(
      "File", specimen.file,
      "Text that lists spheres: a specimen.csv, columns that a header names with their units, or what other "
      "programs write.");
  Words<SpecimenFormat> formats = words_of_formats();
  formats.insert(formats.begin(), {"automatic", SpecimenFormat::automatic});
  read.entry<SpecimenFormat>("File format", specimen.form.format, formats,
                             "How File lists spheres. Columns: named by a header, x, y, z and radius or "
                             "diameter, in m, cm, mm or um, "
                             "others passed over. Yade: text export. LAMMPS: write_data of atom style "
                             "sphere, dump custom with x y z "
                             "radius, its last frame. Automatic: by its first lines.");
  read.text("File columns", specimen.form.columns,
            "Names of the columns of a File without a header, commas between them: \"id, x_mm, y_mm, z_mm, "
            "diameter_mm\".");
  read.file("Bond file", specimen.bond_file,
            "Pairs of spheres that are bonded, and no others: columns a, b and, if wanted, strength_factor, "
            "broken (0, "
            "1: no bond). Spheres are named by the column id of File, or by their rows there, from 0.")
      .unless("Effects/Bond", {"none"});
  section
      .value("Export", specimen.exports, "", "with commas between them, any of " + joined(names_of_exports()),
             read_exports,
             "What a packing is written as too: specimen.yade.txt, specimen.data, specimen.dump.")
      .only_if([](const Situation &s) { return !s.program.bonds; }, "only platen-pack writes them");
  section
      .entry<dem::EndPreparation>(
          "Ends", specimen.ends,
          {{"as packed", dem::EndPreparation::as_packed},
           {"ground", dem::EndPreparation::ground},
           {"convex", dem::EndPreparation::convex},
           {"concave", dem::EndPreparation::concave},
           {"not parallel", dem::EndPreparation::not_parallel},
           {"rough", dem::EndPreparation::rough}},
          "As packed: the platens meet spheres where they are. Ground: spheres of the end layer are "
          "seated flush, as if sawn. The others: ground to a face that is not flat, as high as End height "
          "from its lowest point to its highest; not parallel: an inclined plane, highest at -x; rough: each "
          "sphere by chance.")
      .member("ends");
  const std::string flat = "Specimen/Ends";
  section
      .entry("End height", specimen.end_height, "m", above(0),
             "Of an end face that is not flat, from its lowest point to its highest.")
      .unless(flat, {"as packed", "ground"})
      .member("end_height");
  section
      .entry<dem::FacedEnds>(
          "End faces", specimen.end_faces,
          {{"top", dem::FacedEnds::top}, {"bottom", dem::FacedEnds::bottom}, {"both", dem::FacedEnds::both}},
          "Which ends are not flat; the other one is ground.")
      .unless(flat, {"as packed", "ground"});
  section
      .number("End layer", specimen.end_layer, between(0.05, 10),
              "Depth of the ground layer in mean sphere radii; it decides the strength below 1.")
      .unless("Specimen/Ends", {"as packed"})
      .member("end_layer");
  section
      .text("Cache", specimen.cache,
            "Folder where packings are kept for other runs, found by all that decides them. default: that of "
            "the user, ~/.cache/platen/packings; none: each run packs.")
      .unless("Specimen/Packing", {"file"});
  section.entry("Seat", specimen.seat, "Ground spheres resist rocking on the platen by their flat face.");
  section
      .entry<bool>("Section", specimen.net_section, {{"nominal", false}, {"net", true}},
                   "What stresses are over. Nominal: the section of the shape. Net: the part of it that the "
                   "spheres fill with their pores, where that is the same at all heights; the nominal one "
                   "where they fill it.")
      .member("net_section");
  section
      .entry(
          "Notch depth", specimen.notch.depth, "m", at_least(0),
          "Of a notch that is cut into a bar before it is bent, from its lower face at mid-span, through its "
          "whole breadth: spheres with centres in it are taken away, no bond crosses it; 0: none.")
      .member("specimen.notch_depth");
  section
      .entry("Notch width", specimen.notch.width, "m", at_least(0),
             "Of that notch along the bar; 0: bonds are cut alone.")
      .only_if([](const Scene &s) { return s.specimen.notch.is_there(); }, "Specimen/Notch depth is 0")
      .member("specimen.notch_width");
  declare_flaws(parameters, specimen);
}

void declare_material(Parameters &parameters, dem::ModelSettings &model, dem::ContactSettings &contact) {
  Section section(parameters, "Material");
  Members of(section, model);
  of("density");
  of("density_of");
  Members grains(section.only_if(
                     [](const Scene &s) {
                       return s.effects.contact == dem::NormalContact::hertz ||
                              s.contact.stiffness.kind == Stiffness::Kind::of_bulk || s.hertz_on_platens();
                     },
                     "no contact law takes it"),
                 contact);
  grains("young_modulus");
  grains("poisson_ratio");
}

void declare_effects(Parameters &parameters, Scene &scene) {
  Section section(parameters, "Effects");
  Words<int> laws{{"none", Bond::none}};
  for (const char *word : dem::BondLaws::words)
    laws.emplace_back(word, static_cast<int>(laws.size()) - 1);
  section.entry<int>("Bond", scene.bond.law, laws, "What holds the grains together.").member("model.bond");
  Words<std::optional<dem::NormalContact>> contacts{{"none", std::nullopt}};
  for (const auto &[word, law] : dem::NormalContacts::words())
    contacts.emplace_back(word, law);
  section.entry("Contact", scene.effects.contact, contacts,
                "Normal force between grains that touch without a bond.");
  Members(section, scene.contact)("tangential");
  section.entry("Rotation", scene.model.rotation,
                "Grains turn; without it bonds and contacts carry no moments.");
  LawMembers(section, scene.bond.laws)("bond_moments");
  LawMembers(section, scene.bond.laws)("interface_moments")
      .only_if([](const Scene &s) { return s.model.rotation; }, "Effects/Rotation is off");
  section.entry("Gravity", scene.effects.gravity, "9.80665 m/s2 along -z.");
  section.entry("Energy ledger", scene.model.energy_ledger,
                "Energies and works in history.csv; without it their columns are empty.");
  section.entry("Crack log", scene.model.crack_log, "cracks.csv; without it broken bonds are counted alone.");
}

void declare_contact(Parameters &parameters, dem::ContactSettings &contact) {
  Section section(parameters, "Contact");
  Members of(section, contact);
  of("friction").unless("Effects/Tangential", {"none"});
  Members linear(section.only_if("Effects/Contact", {dem::LinearContact::word}), contact);
  for (const char *member : {"stiffness", "tangential_ratio", "damping"})
    linear(member);
  of("restitution").only_if("Effects/Contact", {dem::HertzContact::word});
  of("rolling_friction").only_if("Effects/Tangential", {"coulomb with rolling resistance"});
  of.rest({"tangential", "young_modulus", "poisson_ratio"});
}

} // namespace platen::apps
