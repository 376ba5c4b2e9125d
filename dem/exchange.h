// Interface of a model to a specimen cut over several processes (ranks): which rank computes which blocks,
// and what ranks exchange in a step. dist/ implements it with MPI; the particle library needs no more.
#pragma once

#include <cstddef>
#include <vector>

#include "base/exact_sum.h"
#include "base/parallel.h"

namespace platen::dem {

class Model;
struct Crack;
struct Particles;
struct PairBlocks;

// Blocks of 512 rows that this rank computes, ascending. Outer blocks reach particles of other ranks; inner
// blocks are computed during the exchange of positions (first) and of forces (last). The lists are computed
// in portions, between which messages may progress.
struct OwnBlocks {
  BlockList all, outer, first_inner, last_inner;
};

// Sums of a step after the drift: of one rank or of all.
struct StepSums {
  double fastest = 0;     // m/s
  ExactSum speed_squares; // m^2/s^2
  long breaks = 0;        // of bonds since the specimen was cut, up to the step before
};

class Exchange {
public:
  virtual ~Exchange() = default;
  virtual int ranks() const = 0;
  virtual const OwnBlocks &blocks() const = 0;

  // Calls of a step, in this order. Position and motion of particles that other ranks need, after the drift.
  virtual void send_motion(const Particles &particles) = 0;
  virtual void start_sums(const StepSums &own) = 0;
  virtual void receive_motion(Particles &particles) = 0;
  virtual StepSums finish_sums() = 0;
  // Lets messages progress: large messages do so only while both ranks call.
  virtual void progress() = 0;
  // Send the forces of pairs of own blocks on particles of other ranks: of bonds after the outer blocks; of
  // contacts after all blocks.
  virtual void send_bond_ghosts(const PairBlocks &blocks) = 0;
  virtual void send_contact_ghosts(const PairBlocks &blocks) = 0;
  // Puts received forces behind the own ghosts. Null: there are none of that kind.
  virtual void receive_ghosts(PairBlocks *bonds, PairBlocks *contacts) = 0;

  // Sends bytes to each rank, in a step; each rank receives those of all, itself included, in the order of
  // ranks. No rank sends more than `most`, the same value on all ranks.
  virtual void send_to_all(const std::vector<char> &bytes, std::size_t most) = 0;
  struct Received {
    const char *data = nullptr; // valid until the next send_to_all()
    std::size_t count = 0;
  };
  virtual std::vector<Received> receive_from_all() = 0;
  // The same at once, one after the other.
  virtual std::vector<char> all_bytes(const std::vector<char> &own) = 0;

  // Gathers the present motion of all particles on all ranks.
  virtual void gather_motion(Particles &particles) = 0;
  // To call after a wide contact search: updates which particles are needed from now on.
  virtual void renew_contacts(Model &model) = 0;
  // Rows that all ranks receive in every step from now on, ascending; null: all rows.
  virtual void share_rows(const std::vector<int> *rows) = 0;

  // Breaks of all ranks, sorted by time and number of the bond.
  virtual std::vector<Crack> all_cracks(const std::vector<Crack> &own) = 0;
  virtual ExactSum all(ExactSum own) = 0;
  virtual long all(long own) = 0;     // their sum
  virtual long largest(long own) = 0; // of all ranks

  // Gathers `bytes` bytes for each block of particles: every rank gives those of its own blocks and receives
  // all.
  virtual void gather_blocks(void *of_blocks, std::size_t bytes) = 0;
  // Adds up the sums of which each rank has a part: the first rank then has the totals, the others 0.
  virtual void sum_up(Model &model) = 0;
  // gather(): every rank has all rows of the tables, as one rank would. scatter(): back to the own rows.
  virtual void gather(Model &model) = 0;
  virtual void scatter(Model &model) = 0;
};

} // namespace platen::dem
