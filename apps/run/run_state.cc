#include "apps/run/run_state.h"

namespace platen::apps {
namespace {

void save_search(CheckpointWriter &to, const dem::ContactSearch::State &s) {
  to.add("search/moved", std::vector<double>{s.moved_since_wide, s.moved_since_close});
  to.add("search/valid", std::vector<int>{s.wide_valid, s.close_valid});
  to.add("search/wide", s.wide);
  to.add("search/close", s.close);
  to.add("search/rest", s.rest);
}

dem::ContactSearch::State load_search(const CheckpointReader &from) {
  dem::ContactSearch::State s;
  std::vector<double> moved;
  std::vector<int> valid;
  from.get("search/moved", moved);
  from.get("search/valid", valid);
  if (moved.size() != 2 || valid.size() != 2) throw CheckpointError("block search/moved has another length");
  s.moved_since_wide = moved[0];
  s.moved_since_close = moved[1];
  s.wide_valid = valid[0];
  s.close_valid = valid[1];
  from.get("search/wide", s.wide);
  from.get("search/close", s.close);
  from.get("search/rest", s.rest);
  return s;
}

} // namespace

void save_state(CheckpointWriter &to, const coupling::Problem &problem, const Results &results,
                const FileMarks &marks) {
  const dem::Model &model = problem.model;
  to.add("problem", problem.numbers());
  to.add_text("reason", problem.time_step_reason());
  to.add_text("instruction_set", dem::name(model.settings().instruction_set));
  to.add_table("particles", model.particles.table);
  if (model.bonds) {
    to.add_table("bonds", model.bonds->table);
    to.add_table("bond_records", model.bonds->records);
  }
  if (model.contacts) {
    to.add_table("contacts", model.contacts->table);
    save_search(to, model.contacts->search_state().state());
  }
  to.add("top/body", problem.top.state());
  to.add("bottom/body", problem.bottom.state());
  to.add_table("top/contacts", problem.top_layer.history());
  to.add_table("bottom/contacts", problem.bottom_layer.history());
  if (const coupling::Sleeve *sleeve = problem.sleeve()) {
    to.add("sleeve/body", sleeve->state());
    to.add_table("sleeve/contacts", sleeve->layer.history());
  }
  if (problem.confinement() != nullptr) to.add_table("confinement", problem.confinement()->table());
  to.add("samples", results.samples());
  to.add("results", results.progress());
  to.add("cracks/pulses", results.emission().pulses);
  to.add("cracks/rose", results.emission().rose);
  to.add("marks", marks);
}

dem::InstructionSet resumed_instruction_set(const CheckpointReader &from, RunLog &log) {
  const dem::InstructionSet best = dem::best_instruction_set();
  if (!from.has("instruction_set")) return best; // written before there was one
  const std::string begun = from.text("instruction_set");
  for (const dem::InstructionSet set :
       {dem::InstructionSet::baseline, dem::InstructionSet::avx2, dem::InstructionSet::avx512})
    if (begun == dem::name(set) && set <= best) return set;
  log.warning(
      "began with the instruction set {}, which this machine lacks: goes on with {}, and its last digits are "
      "no longer those of one machine",
      begun, dem::name(best));
  return best;
}

FileMarks load_state(const CheckpointReader &from, coupling::Problem &problem, Results &results) {
  dem::Model &model = problem.model;
  std::vector<double> numbers;
  from.read_table("particles", model.particles.table);
  if (model.bonds) {
    from.read_table("bonds", model.bonds->table);
    from.read_table("bond_records", model.bonds->records);
  }
  if (model.contacts) {
    from.read_table("contacts", model.contacts->table);
    model.contacts->search_state().set_state(load_search(from));
  }
  if (coupling::Sleeve *sleeve = problem.sleeve()) {
    from.get("sleeve/body", numbers);
    sleeve->set_state(numbers);
    from.read_table("sleeve/contacts", sleeve->layer.history());
  }
  if (problem.confinement() != nullptr) from.read_table("confinement", problem.confinement()->table());
  from.get("top/body", numbers);
  problem.top.set_state(numbers);
  from.get("bottom/body", numbers);
  problem.bottom.set_state(numbers);
  from.read_table("top/contacts", problem.top_layer.history());
  from.read_table("bottom/contacts", problem.bottom_layer.history());
  from.get("problem", numbers);
  problem.set_numbers(numbers);
  problem.set_time_step_reason(from.text("reason"));
  problem.restored();
  std::vector<Sample> samples;
  from.get("samples", samples);
  std::vector<dem::CrackPulse> pulses;
  from.get("cracks/pulses", pulses);
  results.restore(std::move(samples), from.value<Results::Progress>("results"), std::move(pulses),
                  from.value<dem::CrackRose>("cracks/rose"));
  return from.value<FileMarks>("marks");
}

} // namespace platen::apps
