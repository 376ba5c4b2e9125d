// The table of everything that a scene file may say: what concerns the whole run, and the order of all
// sections. Defaults stand with the members.
#include "apps/scene/sections.h"
#include "apps/scene/members.h"
#include "apps/scene/standards.h"

namespace platen::apps {
namespace {

void declare_general(Parameters &parameters, General &general) {
  Section section(parameters, "Scene");
  section.text("Title", general.title, "A line that names the scene in logs and reports.");
  section.integer(
      "Seed", general.seed, 0, 4294967295.0,
      "Start of the random numbers of packing and perturbations; the same seed gives the same result.");
  Words<Quality> words;
  for (const QualityWord &one : quality_words())
    words.emplace_back(one.word, one.kind);
  section.entry<Quality>(
      "Quality", general.quality, words,
      "Accuracy against time: entries that a word stands for, each where the scene does not "
      "give it; custom: none. " +
          quality_documentation() +
          " Errors and costs: docs/accuracy.md. The size of the spheres stays the scene's.");
  section.entry<std::string>("Standard", general.standard, words_of_standards(),
                             "By which platen-report --standard reports the test, which has to be one of the "
                             "standard's; nothing of the computation depends on it.");
}

void declare_integration(Parameters &parameters, coupling::TimeStepSettings &time_step,
                         dem::ModelSettings &model) {
  Section section(parameters, "Integration");
  Members of(section, model);
  Members step(section, time_step);
  of("scheme");
  of("dissipation").only_if("Integration/Scheme", {"tchamwa wielgosz"});
  step("safety");
  of("mass_scaling");
  of("local_damping", "Damping");
  of("damping_form")
      .only_if([](const Scene &s) { return s.model.local_damping > 0; }, "Integration/Damping = 0");
  step("fixed_step", "Time step");
  of.rest({"density", "density_of", "bond_dashpot"});
  step.rest();
  section.entry<dem::InstructionSet>(
      "Instruction set", model.instruction_set,
      {{"best", dem::best_instruction_set()}, {"baseline", dem::InstructionSet::baseline}},
      "Baseline repeats to the bit on every x86-64 processor (not: quasi-static platens).");
}

void declare_output(Parameters &parameters, Output &output, Checkpoint &checkpoint) {
  Section section(parameters, "Output");
  section.entry("Every", output.every, "Rows of history.csv: steps or simulated time; 0: chosen by the app.");
  section
      .entry("Fields every", output.fields_every,
             "Frames for ParaView: steps or simulated time; 0: chosen by the app.")
      .unless("Output/Fields", {"off", "false", "no"});
  section.entry("Fields", output.fields, "Write frames for ParaView.");
  section.number("Sound share", output.sound_share, between(0.01, 1),
                 "Share of its bonds that a sphere of an intact piece has kept: two pieces from platen to "
                 "platen are splitting.");
  section.number("Crack roughness", output.crack_roughness, above_up_to(0, 1),
                 "What a crack lets through over one of its width with smooth walls, for permeabilities.");
  section.number(
      "Event reach", output.event_reach, between(0.1, 1000),
      "Cracks this near are of one acoustic event, in mean sphere radii; larger joins more of them.");
  section.number("Event time", output.event_time, between(0, 1000),
                 "And this soon after each other, in times that a wave takes over the reach.");
  Section checkpoints(parameters, "Checkpoint");
  checkpoints.entry(
      "Every", checkpoint.every,
      "Steps, or time of wall clock (\"10 min\"), and at the end of the run; 0: no checkpoints.");
}

} // namespace

void declare_scene(Parameters &parameters, Scene &scene) {
  declare_general(parameters, scene.general);
  declare_specimen(parameters, scene.specimen);
  declare_material(parameters, scene.model, scene.contact);
  declare_effects(parameters, scene);
  declare_bond(parameters, scene.bond, scene.model);
  declare_phases(parameters, scene.phases);
  declare_contact(parameters, scene.contact);
  declare_platens(parameters, scene.platens, scene.loading);
  declare_sleeve(parameters, scene.loading);
  declare_loading(parameters, scene.loading);
  declare_stages(parameters, scene.loading.stage_sections);
  declare_integration(parameters, scene.time_step, scene.model);
  declare_output(parameters, scene.output, scene.checkpoint);
  declare_expect(parameters, scene.expect);
}

} // namespace platen::apps
