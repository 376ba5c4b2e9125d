// What the specimen meets: platens, sleeve and loading. Keys stand in the order of scenes as they are
// written.
#include <algorithm>
#include "apps/scene/layers.h"

#include "apps/scene/members.h"
#include "apps/scene/sections.h"
#include "apps/scene/surfaces.h"
#include "apps/scene/tubes.h"

namespace platen::apps {
namespace {

using By = dem::Weakening::By;

bool any_weakens(const Scene &scene, By by) {
  return scene.platens.any_of([&](coupling::Side side) { return scene.platens.at(side).weakening.by == by; });
}

// Of one platen, whose path in the library's settings is `member`, or of all; "" then.
void declare_friction(Section &section, dem::SurfaceFriction &friction, const std::string &member) {
  const bool of_all = member.empty();
  Members of(section, friction);
  const auto weakens = [](By by) { return [by](const Scene &s) { return any_weakens(s, by); }; };
  of("friction_static");
  of("friction_dynamic");
  Words<By> laws = words_of<dem::SurfaceFriction, By>("friction_law");
  if (!of_all) laws.insert(laws.begin(), {"common", By::nothing});
  if (of_all)
    of("friction_law");
  else
    section.entry("Friction law", friction.weakening.by, laws, "As Platens/Friction law; common: as both.");
  of("slip_length").only_if(weakens(By::slip), "no Friction law is slip weakening");
  of("slip_velocity").only_if(weakens(By::velocity), "no Friction law is velocity weakening");
  if (of_all) return;
  for (const char *name : {"friction_static", "friction_dynamic", "slip_length", "slip_velocity"})
    section.at(key_of(name))
        .documented("As Platens/" + key_of(name) + " where not given.")
        .member(member + name);
  section.at("Friction law").member(member + "friction_law");
}

void declare_side(Section section, Platens &platens, coupling::Side side) {
  const std::string member = std::string("platens.") + coupling::name_of(side) + ".";
  const int axis = coupling::axis_of(side);
  section.entry<SurfaceKind>("Surface", platens.face(side).surface, surface_words(true),
                             "As Platens/Surface, of this platen alone; common: as both.");
  declare_friction(section, platens.at(side), member);
  const std::string turned = std::string(" As for ") + (coupling::is_high(side) ? "Top" : "Bottom") +
                             ", its z along " +
                             (axis == 0 ? "x, x along y, y along z." : "y, x along z, y along x.");
  section
      .file("Mesh file", platens.face(side).mesh_file,
            "Gmsh mesh of hexahedra (.msh, 2.2 or 4.1) in place of a plate: its extreme plane towards the "
            "specimen is laid on the end, the far plane is the machine's." +
                (axis == 2 ? "" : turned))
      .member(member + "grid");
}

// Left and right along x, front and back along y.
void declare_further_sides(Parameters &parameters, Platens &platens) {
  for (const coupling::Side side : coupling::all_sides)
    if (coupling::axis_of(side) != 2)
      declare_side(Section(parameters, section_of(side))
                       .only_if([side](const Scene &s) { return s.platens.has(side); },
                                "Platens/Sides leaves that side free"),
                   platens, side);
}

constexpr const char *layers_allowed =
    "materials with their thicknesses, commas between them: \"rubber 2 mm, steel 20 mm\"";

void declare_layers(Section &section, Platens &platens) {
  section
      .value("Layers", platens.layers, "", layers_allowed, read_layers,
             "Of deformable platens, from the specimen outward. What they leave of the Thickness is of the "
             "platens' own Young modulus, Poisson ratio and Density, which is the material platen; without a "
             "Thickness platens are as thick as their layers. Of a mesh the physical volumes are the layers, "
             "in their order: the names alone count. Empty: one material, or the Pad on it. Ready words, "
             "with Young "
             "modulus, Poisson ratio and density: " +
                 layer_documentation())
      .member("platens.elastic.layers");
  section.value(
      "Layer materials", platens.layer_materials, "",
      "of each its name, Young modulus, Poisson ratio and density, semicolons between them: \"rubber: 5 "
      "MPa, 0.49, 1100 kg/m3; steel: 210 GPa, 0.3, 7850 kg/m3\"",
      read_layer_materials,
      "What the names in Layers mean; all but platen and the ready words have to be given.");
}

void declare_own_layers(const Section &section, coupling::Side side, std::vector<NamedLayer> &layers) {
  section.unless("Platens/Kind", {"rigid"})
      .value("Layers", layers, "", layers_allowed, read_layers,
             "As Platens/Layers, of this platen alone; empty: as both.")
      .member(std::string("platens.") + coupling::name_of(side) + ".layers");
}

// A mesh may bring a second material of its own.
std::string needs_pad(const Situation &s) {
  const Platens &p = s.scene.platens;
  const double pad = p.elastic->pad_thickness;
  const bool wanted = (pad > 0 && pad < p.thickness) || (p.meshed() && given(p.elastic->pad.young_modulus));
  return s.loads() && p.deformable && wanted ? "the pad has to have one." : "";
}

void declare_elastic(Section section, Platens &platens) {
  Members of(section, *platens.elastic);
  of("motion");
  of("degree");
  of("damping", "Body damping").only_if("Platens/Motion", {"explicit"});
  of("steps_per_solve").only_if("Platens/Motion", {"quasi-static"});
  section
      .entry<bool>("Material law", platens.yielding, {{"elastic", false}, {"yielding", true}},
                   "Of the material of deformable platens; yielding: a metal, which yields by von Mises and "
                   "hardens, with Motion = explicit. Pad and layers of other materials stay elastic.")
      .member("platens.elastic.metal");
  Members metal(section.only_if("Platens/Material law", {"yielding"}), *platens.elastic->metal);
  metal("yield_strength").needed_if([](const Situation &s) {
    const Platens &p = s.scene.platens;
    return s.loads() && p.deformable && p.yielding ? "the platens yield." : "";
  });
  metal.rest();
  declare_layers(section, platens);
  of("pad_thickness");
  Members pad(section.only_if(
                  [](const Scene &s) { return s.platens.elastic->pad_thickness > 0 || s.platens.meshed(); },
                  "platens have no pad"),
              *platens.elastic);
  for (const auto &[member, key] :
       {std::pair("pad_modulus", ""), {"pad_poisson_ratio", "Pad Poisson ratio"}, {"pad_density", ""}})
    pad(member, key).needed_if(needs_pad);
}

} // namespace

void declare_platens(Parameters &parameters, Platens &platens, coupling::LoadingSettings &loading) {
  Section section(parameters, "Platens");
  Members of(section, platens);
  section
      .entry<bool>("Kind", platens.deformable, {{"rigid", false}, {"deformable", true}},
                   "Rigid bodies, or elastic ones by finite elements.")
      .member("platens.elastic");
  section
      .entry(
          "Sides", platens.sides, platen_sides,
          "Which sides of a box have platens; two: top and bottom; four x, four y: left and right (along "
          "x), or front and back (along y), too; six: all. Top and bottom do what Loading says, the others "
          "what its stages ask, and without stages they stand still.")
      .member("platens.left")
      .member("platens.right")
      .member("platens.front")
      .member("platens.back");
  section.entry<SurfaceKind>("Surface", platens.surface, surface_words(false),
                             "What both platens' faces are: the entries that a word stands for, each where "
                             "the scene does not give it. " +
                                 surface_documentation());
  declare_friction(section, platens.both, "");
  of("contact");
  of("contact_modulus")
      .only_if([](const Scene &s) { return s.hertz_on_platens(); },
               "no grain presses on platens by Hertz' law");
  Section linear = section.only_if([](const Scene &s) { return !s.hertz_on_platens(); },
                                   "grains press on platens by Hertz' law");
  linear.stiffness("Stiffness", platens.stiffness, false,
                   "Penalty stiffness of grains on platens; a multiple is that of the mean bond.");
  Members(linear, static_cast<coupling::PlatenSettings &>(platens))("tangential_ratio");
  of("damping");
  of("overhang").unless("Platens/Sides", {"six"});
  of("partial_cover", "Cover")
      .only_if([](const Scene &s) { return s.platens.meshed(); }, "platens have no mesh");
  of("edge_gap").unless("Platens/Sides", {"two"});
  of("strip_width")
      .only_if(
          [](const Situation &s) {
            return s.program.presses == Presses::discs || s.scene.loading.bending() ||
                   s.used_by_program("Platens/Strip width");
          },
          "only platen-brazilian and three point bending have strips");
  of("span").only_if("Loading/Test", {"three point bending"}).remark("Test = three point bending");
  for (const char *member : {"thickness", "elements_across", "density"})
    of(member);
  of("young_modulus").unless("Platens/Kind", {"rigid"});
  of("poisson_ratio")
      .only_if(
          [](const Scene &s) {
            return s.platens.deformable || (s.hertz_on_platens() && s.platens.contact_modulus > 0);
          },
          "Platens/Kind = rigid");
  declare_elastic(section.unless("Platens/Kind", {"rigid"}), platens);
  section.entry("Mesh unit", platens.mesh_unit, "m", above(0), "Unit of length of the mesh files.")
      .only_if([](const Scene &s) { return s.platens.meshed(); }, "no platen has a Mesh file");
  of("glued", "Attachment");
  Members machine(section, platens.machine);
  machine("stiffness", "Machine stiffness");
  const Section behind = section.only_if([](const Scene &s) { return s.platens.machine.yields(); },
                                         "Platens/Machine stiffness is not set");
  Members yielding(behind, platens.machine);
  yielding("mass", "Machine mass");
  yielding("damping", "Machine damping");
  of.rest({"spherical_seat", "seat_friction_arm", "eccentricity", "tilt"});
  Section top(parameters, "Platens/Top"), bottom(parameters, "Platens/Bottom");
  declare_side(top, platens, coupling::Side::top);
  Members control(top, loading);
  control("servo", "Control");
  Members obliquely(top, static_cast<coupling::PlatenSettings &>(platens));
  obliquely("spherical_seat", "Seat");
  obliquely("seat_friction_arm");
  obliquely("eccentricity");
  obliquely("tilt");
  control("top_stress", "Stress").unless("Platens/Top/Control", {"motion"}).remark("Control = stress");
  declare_own_layers(top, coupling::Side::top, platens.top_layers);
  declare_side(bottom, platens, coupling::Side::bottom);
  declare_own_layers(bottom, coupling::Side::bottom, platens.bottom_layers);
  declare_further_sides(parameters, platens);
}

void declare_sleeve(Parameters &parameters, Loading &loading) {
  Section section =
      Section(parameters, "Sleeve")
          .only_if(
              [](const Situation &s) { return s.scene.loading.sleeved() || s.used_by_program("Sleeve"); },
              "Loading/Confinement is not sleeve");
  coupling::SleeveSettings &sleeve = *loading.cell->sleeve;
  const std::vector<std::string> tube{"tube"}, passive{"tube", "wrap"};
  section
      .entry<SleeveKind>(
          "Kind", loading.sleeve_kind,
          {{"rubber", SleeveKind::rubber}, {"tube", SleeveKind::tube}, {"wrap", SleeveKind::wrap}},
          "rubber: in a cell, whose pressure acts through it; tube: of metal that yields, and wrap: of "
          "fibres in resin that tear, confine the specimen because it presses them.")
      .member("loading.tube");
  Members of(section, sleeve);
  Members metal(section.only_if("Sleeve/Kind", tube), *sleeve.metal);
  section.only_if("Sleeve/Kind", tube)
      .entry<Steel>("Steel", loading.steel, steel_words(), steel_documentation());
  metal("yield_strength").needed_if([](const Situation &s) {
    return s.loads() && s.scene.loading.tubed() && !s.scene.loading.wrapped() ? "a tube yields." : "";
  });
  for (const char *member : {"ultimate_strength", "saturation", "saturation_rate"})
    metal(member);
  section.only_if("Sleeve/Kind", tube)
      .file("Hardening file", loading.hardening_file,
            "A table of plastic_strain and flow_stress_pa (or flow_stress_mpa), true stress and strain, "
            "after the "
            "yield strength; instead of an ultimate strength.");
  Members wrap(section.only_if("Sleeve/Kind", {"wrap"}), *sleeve.wrap);
  wrap("rupture_strain").needed_if([](const Situation &s) {
    return s.loads() && s.scene.loading.wrapped() ? "a wrap tears." : "";
  });
  wrap.rest();
  for (const char *member : {"gap", "clearance"})
    of(member).only_if("Sleeve/Kind", passive);
  of("recess").only_if("Sleeve/Kind", tube);
  of("thickness");
  of("young_modulus", "Modulus");
  for (const char *member : {"poisson_ratio", "density"})
    of(member);
  of("bonded_rims", "Rims");
  for (const char *member : {"elements_around", "elements_through", "friction"})
    of(member);
  of("bond_strength").only_if("Sleeve/Kind", passive);
  for (const char *member : {"bond_tension", "bond_slip"})
    of(member)
        .only_if("Sleeve/Kind", passive)
        .only_if([](const Scene &s) { return s.loading.cell->sleeve->contact.bond.strength > 0; },
                 "Sleeve/Bond strength is 0");
  of("stiffness");
  of("seat_layer", "Seat depth");
  of("contact_damping");
  of("mass_damping", "Damping");
  of.rest();
}

void declare_loading(Parameters &parameters, Loading &loading) {
  Section section(parameters, "Loading");
  const auto unstaged = [](const Scene &s) { return !s.loading.staged(); };
  const std::string staged = "Loading/Stage 1 is there";
  const Section axial = section.unless("Loading/Test", {"hydrostatic"}),
                cell =
                    section.unless("Loading/Confinement", {"none"}).unless("Sleeve/Kind", {"tube", "wrap"});
  Members of(section, loading), along(axial, loading);
  Members in(cell, *loading.cell), alone(cell.only_if(unstaged, staged), *loading.cell);
  section
      .entry("Test", loading.test, loading_tests,
             "The platens approach or part; hydrostatic: they and the lateral surface press alike, up to "
             "Confining pressure; uniaxial strain: they approach while a stiff frictionless wall "
             "holds the lateral surface; three point bending: strips approach, one above the middle of a bar "
             "along x, two below.")
      .member("loading.tension")
      .member("loading.wall");
  along("rate", "Axial rate").needed_if([](const Situation &s) {
    const bool own = s.loads() && s.program.presses != Presses::trials;
    return own && !s.scene.loading.hydrostatic() && !s.scene.loading.staged() && !s.rate_by_transits() &&
                   !s.given_by_program("Loading/Axial rate")
               ? "the platens have to move."
               : "";
  });
  of("wave_transits", "Wave crossings")
      .only_if([](const Scene &s) { return !given(s.loading.rate); }, "Loading/Axial rate is set");
  along("rate_multiplier", "Hurry").unless("Platens/Top/Control", {"stress"});
  of("ramp");
  of("hold")
      .only_if([](const Scene &s) { return s.loading.servo || s.loading.confined(); },
               "Platens/Top/Control = motion")
      .only_if(unstaged, staged);
  of("start_strain");
  along("target_strain").only_if(unstaged, staged);
  Section(axial).number("Stop at residual", loading.stop_at_residual, between(0, 0.99),
                        "Stress after the peak, as a fraction of it, at which the run is over; 0: never.");
  of("servo_gain")
      .only_if([](const Scene &s) { return s.loading.servo || s.loading.confined() || s.loading.staged(); },
               "Platens/Top/Control = motion");
  section
      .entry<ConfinementKind>(
          "Confinement", loading.confinement,
          {{"none", ConfinementKind::none},
           {"particles", ConfinementKind::particles},
           {"sleeve", ConfinementKind::sleeve}},
          "How the lateral surface is pressed; particles: by forces on those of the surface; sleeve: by oil "
          "through rubber of finite elements, or by a tube or a wrap (Sleeve/Kind).")
      .member("loading.cell");
  alone("pressure", "Confining pressure");
  alone("ramp", "Confining ramp");
  in("path", "Pressure path").unless("Loading/Test", {"hydrostatic"});
  of("wall_stiffness").only_if("Loading/Test", {"uniaxial strain"});
  of("unload_at");
  of("unload_to")
      .only_if([](const Scene &s) { return !s.loading.unload_at.empty(); }, "Loading/Unload at is empty");
  in("area", "Confinement area").only_if("Loading/Confinement", {"particles"});
  of.rest({"servo", "top_stress"});
  in.rest();
}

} // namespace platen::apps
