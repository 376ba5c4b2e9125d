// The table of everything that a scene file may say: what concerns the whole run, and the order of all
// sections. Defaults stand in scene.h, with the members.
#include "apps/scene/sections.h"

namespace platen::apps {

void declare_general(Parameters &parameters, General &general) {
  Section section(parameters, "Scene");
  section.text("Title", general.title, "A line that names the scene in logs and reports.");
  section.integer(
      "Seed", general.seed, 0, 4294967295.0,
      "Start of the random numbers of packing and perturbations; the same seed gives the same result.");
  std::vector<std::pair<std::string, Quality>> words;
  for (const QualityWord &one : quality_words())
    words.emplace_back(one.word, one.kind);
  section.word<Quality>(
      "Quality", general.quality, words,
      "Accuracy against time: entries that a word stands for, each where the scene does not "
      "give it; custom: none. " +
          quality_documentation() +
          " Errors and costs: docs/accuracy.md. The size of the spheres stays the scene's.");
}

void declare_integration(Parameters &parameters, Integration &integration) {
  Section section(parameters, "Integration");
  section.word<Scheme>(
      "Scheme", integration.scheme,
      {{"velocity verlet", Scheme::velocity_verlet}, {"tchamwa wielgosz", Scheme::tchamwa_wielgosz}},
      "Tchamwa Wielgosz takes energy from fast swings by the drift itself, for slow tests.");
  section.number(
      "Dissipation", integration.dissipation, between(1, 1.5),
      "phi of tchamwa wielgosz: a swing of frequency w is damped by (phi - 1) w dt / 2 of critical; "
      "1: none, which is velocity Verlet.");
  section.number("Safety", integration.safety, above_up_to(0, 1), "Time step over the stability limit.");
  section.number("Mass scaling", integration.mass_scaling, between(1, 1e6),
                 "Factor on all masses; the time step grows by its root, and inertia with it.");
  section.number("Damping", integration.damping, {0, 1, true, false},
                 "Local damping: force against the motion, as a fraction of the unbalanced force.");
  section.word<DampingForm>(
      "Damping form", integration.damping_form,
      {{"component", DampingForm::component}, {"vector", DampingForm::vector}},
      "Local damping of each component of a force by itself, or of the whole along the velocity.");
  section.quantity("Time step", integration.time_step, "s", at_least(0),
                   "0: Safety times the limit; a larger one than the limit is refused.");
  section.word<InstructionSet>("Instruction set", integration.instruction_set,
                               {{"best", InstructionSet::best}, {"baseline", InstructionSet::baseline}},
                               "Baseline repeats to the bit on every x86-64 processor.");
}

void declare_output(Parameters &parameters, Output &output, Checkpoint &checkpoint) {
  Section section(parameters, "Output");
  section.interval("Every", output.every,
                   "Rows of history.csv: steps or simulated time; 0: chosen by the app.");
  section.interval("Fields every", output.fields_every,
                   "Frames for ParaView: steps or simulated time; 0: chosen by the app.");
  section.flag("Fields", output.fields, "Write frames for ParaView.");
  section.number("Sound share", output.sound_share, between(0.01, 1),
                 "Share of its bonds that a sphere has kept to be of a cone.");
  section.number(
      "Event reach", output.event_reach, between(0.1, 1000),
      "Cracks this near are of one acoustic event, in mean sphere radii; larger joins more of them.");
  section.number("Event time", output.event_time, between(0, 1000),
                 "And this soon after each other, in times that a wave takes over the reach.");
  Section checkpoints(parameters, "Checkpoint");
  checkpoints.interval("Every", checkpoint.every,
                       "Steps, or time of wall clock (\"10 min\"); 0: no checkpoints.");
}

void declare_scene(Parameters &parameters, Scene &scene) {
  declare_general(parameters, scene.general);
  declare_specimen(parameters, scene.specimen);
  declare_material(parameters, scene.material);
  declare_effects(parameters, scene.effects);
  declare_bond(parameters, scene.bond);
  declare_phases(parameters, scene.phases);
  declare_contact(parameters, scene.contact);
  declare_platens(parameters, scene.platens);
  declare_sleeve(parameters, scene.sleeve);
  declare_loading(parameters, scene.loading);
  declare_integration(parameters, scene.integration);
  declare_output(parameters, scene.output, scene.checkpoint);
  declare_expect(parameters, scene.expect);
  declare_pair_test(parameters, scene.pair_test);
  declare_calibrate(parameters, scene.calibrate);
  declare_bar_test(parameters, scene.bar_test);
  declare_study(parameters, scene.study);
}

} // namespace platen::apps
