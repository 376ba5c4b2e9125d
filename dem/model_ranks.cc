// A specimen that is cut over ranks: the work of a step during communication, and the collection of the data
// of all ranks.
#include <cstring>
#include <utility>

#include "base/parallel.h"
#include "dem/measure/damage.h"
#include "dem/model.h"

namespace platen::dem {
namespace {

// With ranks, per thread: about fifty microseconds.
constexpr std::size_t blocks_between_progress = 2;

} // namespace

// Inner blocks are computed during the communication.
void Model::start_exchange(double dt) {
  exchange_->send_motion(particles);
  exchange_->start_sums({motion_.fastest, motion_.speed_squares, own_breaks_});
  compute_portions(dt, exchange_->blocks().first_inner);
  exchange_->receive_motion(particles);
  const StepSums sums = exchange_->finish_sums();
  motion_ = {sums.fastest, sums.speed_squares};
  known_breaks_ = breaks_before_sharing_ + sums.breaks;
}

// Outer blocks come first, so that their forces on particles of other ranks are sent while the remaining
// inner blocks are computed.
void Model::compute_shared(double dt, const Loop &parallel_loop, const std::function<void()> &done) {
  const OwnBlocks &blocks = exchange_->blocks();
  compute_portions(dt, blocks.outer, parallel_loop);
  if (done) done();
  finish_breaks(dt);
  compute_again();
  if (bonds) exchange_->send_bond_ghosts(bonds->blocks);
  compute_portions(dt, blocks.last_inner);
  finish_breaks(dt);
  compute_contacts(dt, &blocks.all);
  if (contacts) exchange_->send_contact_ghosts(contacts->blocks());
}

// `parallel_loop` runs with the last portion.
void Model::compute_portions(double dt, const BlockList &listed, const Loop &parallel_loop) {
  const std::size_t portion = blocks_between_progress * static_cast<std::size_t>(loop_threads());
  BlockList some;
  for (std::size_t first = 0; first + portion < listed.size(); first += portion) {
    some.assign(listed.begin() + static_cast<std::ptrdiff_t>(first),
                listed.begin() + static_cast<std::ptrdiff_t>(first + portion));
    compute_bonds(dt, &some);
    exchange_->progress();
  }
  const std::size_t rest = listed.empty() ? 0 : (listed.size() - 1) / portion * portion;
  some.assign(listed.begin() + static_cast<std::ptrdiff_t>(rest), listed.end());
  compute_bonds(dt, &some, parallel_loop);
  exchange_->progress();
}

void Model::share(std::unique_ptr<Exchange> exchange) {
  exchange_ = std::move(exchange);
}

void Model::settle() {
  if (!exchange_) return;
  for (const Crack &crack : exchange_->all_cracks(std::exchange(unsettled_, {}))) {
    count(crack);
    bonds->state[crack.record] = static_cast<int>(crack.mode);
    bonds->break_time[crack.record] = crack.time;
  }
}

void Model::gather_motion() {
  if (!exchange_ || !cut_) return;
  settle();
  exchange_->gather_motion(particles);
}

std::vector<double> Model::bond_losses() const {
  std::vector<double> losses = dem::bond_losses(*bonds);
  if (!exchange_ || !cut_ || !damaged_rows_separate(bonds->law)) return losses;
  struct Loss {
    std::size_t record;
    double value;
  };
  std::vector<char> own;
  for (const int record : bonds->record) {
    const Loss loss{static_cast<std::size_t>(record), losses[static_cast<std::size_t>(record)]};
    const char *bytes = reinterpret_cast<const char *>(&loss);
    if (loss.value > 0) own.insert(own.end(), bytes, bytes + sizeof(Loss));
  }
  const std::vector<char> all = exchange_->all_bytes(own);
  for (std::size_t at = 0; at < all.size(); at += sizeof(Loss)) {
    Loss loss;
    std::memcpy(&loss, all.data() + at, sizeof(Loss));
    losses[loss.record] = loss.value;
  }
  return losses;
}

void Model::settle_state() {
  if (!exchange_ || !cut_) return;
  settle();
  if (bonds) bonds->compact();
  exchange_->sum_up(*this);
}

void Model::gather() {
  if (!exchange_ || !cut_) return;
  settle();
  if (bonds) bonds->compact();
  exchange_->gather(*this);
  cut_ = false;
}

void Model::scatter() {
  if (!exchange_ || cut_) return;
  exchange_->scatter(*this);
  own_breaks_ = 0;
  breaks_before_sharing_ = broken_tension + broken_shear;
  cut_ = true;
}

Ghosts Model::ghosts() const {
  return {bonds ? &bonds->blocks : nullptr, contacts ? &contacts->blocks() : nullptr};
}

void Model::receive_ghosts() {
  if (exchange_)
    exchange_->receive_ghosts(bonds ? &bonds->blocks : nullptr, contacts ? &contacts->blocks() : nullptr);
}

} // namespace platen::dem
