#include "coupling/problem.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "coupling/text_of.h"
#include "dem/not_finite.h"
#include "dem/parallel.h"

namespace platen::coupling {
namespace {

// The step is looked at again after this many steps, if contacts have grown by this share of the particles.
constexpr long steps_between_choices = 400;
constexpr double growth_of_contacts = 0.02;
// What touches nothing shows in no sum, so all are looked at after this many steps: a thousandth of their
// cost.
constexpr long steps_between_looks = 100;
// A contact between what moves on both sides: k (a - b)^2 <= k (1 + s) a^2 + k (1 + 1/s) b^2, so that each
// side may be looked at alone.
constexpr double share_of_bodies = 0.25;

} // namespace

std::vector<dem::GroundSpring> Problem::ground_springs() const {
  std::vector<dem::GroundSpring> springs = bottom_layer.ground_springs(model.particles, bottom);
  const std::vector<dem::GroundSpring> more = top_layer.ground_springs(model.particles, top);
  springs.insert(springs.end(), more.begin(), more.end());
  return springs;
}

std::vector<dem::GroundSpring> Problem::springs_at(bool top_platen) {
  ContactLayer &layer = top_platen ? top_layer : bottom_layer;
  const fem::Body &body = top_platen ? top : bottom;
  layer.make_list(model.particles, body);
  return layer.ground_springs(model.particles, body, true);
}

std::size_t Problem::springs_near() const {
  return (model.contacts ? model.contacts->table.size() : 0) + top_layer.closed + bottom_layer.closed;
}

// Lists are made now, so that it is the same whether the run was stopped and resumed on its way or not.
dem::StableStep Problem::limit_now() {
  top_layer.make_list(model.particles, top);
  bottom_layer.make_list(model.particles, bottom);
  std::vector<dem::GroundSpring> springs = ground_springs();
  near_at_choice_ = (model.contacts ? model.contacts->table.size() : 0) + springs.size();
  if (wall_) {
    wall_->make_list(model.particles);
    const std::vector<dem::GroundSpring> more = wall_->ground_springs(model.particles);
    springs.insert(springs.end(), more.begin(), more.end());
  }
  if (sleeve_) {
    sleeve_->layer.make_list(model.particles, sleeve_->solid);
    const std::vector<dem::GroundSpring> more =
        sleeve_->layer.ground_springs(model.particles, sleeve_->solid);
    springs.insert(springs.end(), more.begin(), more.end());
  }
  if (deformable())
    for (dem::GroundSpring &s : springs) {
      s.normal_stiffness *= 1 + share_of_bodies;
      s.tangential_stiffness *= 1 + share_of_bodies;
    }
  dem::StableStep limit = model.stable_step(springs, settings_.platens.damping);
  const double bodies = deformable() ? limit_of_bodies() : limit.limit;
  if (bodies < limit.limit) {
    limit.limit = bodies;
    limit.reason = "the finite elements of a platen with the springs of its contacts";
  }
  if (sleeve_ && sleeve_->longest_interval() < limit.limit) {
    limit.limit = sleeve_->longest_interval();
    limit.reason = reason_of_sleeve;
  }
  return limit;
}

// The step never grows: bonds that break only soften, contacts that close may stiffen.
void Problem::choose_step(bool first) {
  const dem::StableStep limit = limit_now();
  if (settings_.fixed_step > 0) {
    if (settings_.fixed_step > limit.limit) {
      const std::string above =
          "is above the stability limit of " + text_of(limit.limit) + " s (" + limit.reason + ")";
      if (first)
        throw BadSetup("Integration/Time step", above + ". Allowed: up to that, or 0: the program chooses.");
      throw NumericsStopped("the time step of " + text_of(settings_.fixed_step) + " s " + above + " at " +
                            text_of(time()) +
                            " s; try a smaller Integration/Time step, or leave it to the program");
    }
    time_step_ = settings_.fixed_step;
    reason_ = "given by the scene";
    return;
  }
  const double step = settings_.safety * limit.limit;
  if (!std::isfinite(step))
    throw BadSetup("Integration/Time step",
                   "has to be given: nothing in the scene has a stiffness that would give it.");
  if (first || step < time_step_) {
    time_step_ = step;
    reason_ = limit.reason;
  }
}

double Problem::limit_of_bodies() const {
  double limit = std::numeric_limits<double>::infinity();
  const auto ask = [&](const ContactLayer &layer, const fem::Body &body) {
    fem::VertexSprings springs = layer.vertex_springs(model.particles, body);
    for (std::vector<double> *column : {&springs.stiffness, &springs.dashpot})
      for (double &number : *column)
        number *= 1 + 1 / share_of_bodies;
    limit = std::min(limit, body.stable_step(springs));
  };
  ask(top_layer, top);
  ask(bottom_layer, bottom);
  return limit;
}

void Problem::kick_bodies() {
  top.kick(0.5 * time_step_);
  bottom.kick(0.5 * time_step_);
}

// Shapes follow the loads of the last steps during the next ones.
void Problem::solve_bodies() {
  const int whole = settings_.platens.elastic->steps_per_solve;
  const auto follow = [&](MeanLoads &loads, fem::Body &body) {
    loads.add(body, time_step_);
    if (loads.steps() < whole) return;
    static_cast<fem::ElasticSolid &>(body).aim(loads.mean(), whole * time_step_);
    loads.reset();
  };
  follow(top_loads_, top);
  follow(bottom_loads_, bottom);
}

void Problem::drift_bodies() {
  const auto move = [&](fem::Body &body) {
    body.kick(0.5 * time_step_);
    body.drift(time_step_);
    body.clear_loads();
  };
  if (deformable()) return dem::both([&] { move(top); }, [&] { move(bottom); });
  move(top);
  move(bottom);
}

// A sleeve knows its limit after each of its intervals; it may be shorter than one step as contacts close.
void Problem::look_at_step() {
  if (steps_ == 0) return;
  const bool sleeve_is_stiffer = sleeve_ && time_step_ > sleeve_->longest_interval();
  if (!sleeve_is_stiffer && steps_ % steps_between_choices != 0) return;
  const double grown = static_cast<double>(springs_near()) - static_cast<double>(near_at_choice_);
  if (!sleeve_is_stiffer && grown <= growth_of_contacts * static_cast<double>(model.particles.size())) return;
  dem::StageClock::Lap lap(model.clock, dem::Stage::stable_step);
  choose_step(false);
}

long Problem::advance(long most) {
  if (steps_ == 0) given_energy_ = dem::kinetic_energy(model.particles);
  for (long made = 0; made < most; ++made) {
    const double before = time_step_;
    look_at_step();
    try {
      if (made == 0)
        model.begin_step(time_step_);
      else
        model.end_and_begin_step(before, time_step_);
    } catch (const dem::NotFinite &) {
      stop_not_finite();
    }
    if (!std::isfinite(model.last_motion().speed_squares)) stop_not_finite();
    set_platen_speeds();
    add_forces();
    ++steps_;
    if (!std::isfinite(reaction_top_ + reaction_bottom_)) stop_not_finite();
    if (steps_ % steps_between_looks == 0) require_finite();
    look_at_energy();
    if (made + 1 == most || (model.breaks > 0 && model.settings().crack_log)) {
      model.end_step(time_step_);
      if (!std::isfinite(model.last_sums().unbalanced)) stop_not_finite();
      return made + 1;
    }
  }
  return most;
}

// One step so long that no speed in it counts: what dashpots take of it is their fraction of critical times a
// period over this, and forces at its end, which balance, do nothing.
void Problem::carry(const std::vector<dem::Vector3> &displacement, const std::vector<dem::Vector3> &turn,
                    double way) {
  if (steps_ > 0) throw std::logic_error("a problem is carried to its start before its first step");
  if (deformable()) throw std::logic_error("only rigid platens are carried to a start");
  constexpr double unhurried = 1; // s, against periods of microseconds
  dem::Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = displacement[i] / unhurried;
    if (p.has_rotation() && !turn.empty()) (*p.angular_velocity)[i] = turn[i] / unhurried;
  }
  top.set_velocity({0, 0, -way / unhurried});
  bottom.set_velocity({0, 0, way / unhurried});
  const double chosen = time_step_, damped = model.works.damping;
  time_step_ = unhurried;
  model.begin_step(unhurried);
  add_forces();
  model.end_step(unhurried);
  time_step_ = chosen;
  if (model.breaks > 0)
    throw BadSetup("Loading/Start strain", "breaks " + std::to_string(model.breaks) +
                                               " bonds at once, which a static solve does not follow. "
                                               "Allowed: less, before the first crack.");
  model.works.damping = damped; // of the kick alone, which is taken back
  model.time = 0;
  std::fill(p.velocity.begin(), p.velocity.end(), dem::Vector3{});
  if (p.has_rotation()) std::fill(p.angular_velocity->begin(), p.angular_velocity->end(), dem::Vector3{});
  top.set_velocity({0, 0, 0});
  bottom.set_velocity({0, 0, 0});
}

// All but the particles' motion. What platens do to particles is found while bonds are: its parts are small,
// for threads that are done with theirs.
void Problem::add_forces() {
  const double dt = time_step_;
  {
    dem::StageClock::Lap lap(model.clock, dem::Stage::bodies);
    drift_bodies();
    if (sleeve_) move_sleeve();
  }
  std::size_t below = 0, above = 0, around = 0;
  {
    dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
    announce_motion(dt);
    below = bottom_layer.prepare(model.particles, bottom);
    above = top_layer.prepare(model.particles, top);
    if (sleeve_) around = sleeve_->layer.prepare(model.particles, sleeve_->solid);
  }
  const auto part = [&](std::size_t p) {
    if (p < below)
      bottom_layer.compute_part(model.particles, bottom, dt, p);
    else if (p < below + above)
      top_layer.compute_part(model.particles, top, dt, p - below);
    else
      sleeve_->layer.compute_part(model.particles, sleeve_->solid, dt, p - below - above);
  };
  model.compute_forces(dt, dem::loop_of(below + above + around, part));
  {
    dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
    give_platen_forces();
    if (sleeve_) sleeve_->layer.give_forces(model.particles, sleeve_->solid);
  }
  if (sleeve_) {
    dem::StageClock::Lap lap(model.clock, dem::Stage::bodies);
    load_sleeve();
  }
  if (deformable()) {
    dem::StageClock::Lap lap(model.clock, dem::Stage::bodies);
    kick_bodies();
    if (quasi_static()) solve_bodies();
  }
  dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
  book_reactions();
  if (confinement_) press_skin();
  if (cell()) look_at_cell();
  if (wall_) wall_->add_forces(model.particles, model.last_motion().fastest * dt);
  if (!settings_.loading.unload_at.empty() && axial_stage()) turn_round();
  if (pace_ && axial_stage())
    pace_->look(model.time, 0.5 * (stress_top() + stress_bottom()), closure_strain(),
                static_cast<double>(model.broken_tension + model.broken_shear));
}

bool Problem::platens_apart() {
  const SurfaceSearch &above = top_layer.search(), &below = bottom_layer.search();
  const long made = above.lists_made() + below.lists_made();
  if (made == lists_compared_) return apart_;
  lists_compared_ = made;
  std::vector<int> shared;
  std::set_intersection(above.particles().begin(), above.particles().end(), below.particles().begin(),
                        below.particles().end(), std::back_inserter(shared));
  return apart_ = shared.empty();
}

// At once where no particle feels both platens: then no sum depends on which comes first. Particles are
// sorted by height before all else, so that two threads share them out as here: each platen meets what its
// thread has at hand.
void Problem::give_platen_forces() {
  const auto above = [&] { top_layer.give_forces(model.particles, top); };
  const auto below = [&] { bottom_layer.give_forces(model.particles, bottom); };
  if (platens_apart()) return dem::both(below, above);
  above();
  below();
}

// The machine holds each rigid platen against the particles: its work is minus theirs, by the trapezoid over
// the drift. An elastic one keeps that book itself, at its grip.
void Problem::book_reactions() {
  const double force_top = top.total_force()[2], force_bottom = bottom.total_force()[2];
  if (!deformable())
    boundary_work_ -= 0.5 * time_step_ *
                      ((reaction_top_ + force_top) * top.velocity()[2] +
                       (reaction_bottom_ + force_bottom) * bottom.velocity()[2]);
  reaction_top_ = force_top;
  reaction_bottom_ = force_bottom;
}

} // namespace platen::coupling
