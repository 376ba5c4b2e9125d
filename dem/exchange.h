// One specimen cut over several processes (ranks), as a model sees it: who computes which blocks, and what is
// asked of the others in a step. The particle library knows no more of them; dist/ answers by MPI.
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

// Blocks of 512 rows that this rank computes, ascending. Outer ones reach particles of other ranks; of the
// others, those that are worked out while positions, and while forces, are under way.
// These lists are worked through in portions, between which messages may go on.
struct OwnBlocks {
  BlockList all, outer, first_inner, last_inner;
};

// What every rank knows of a step once its particles have drifted.
struct StepSums {
  double fastest = 0;     // m/s
  ExactSum speed_squares; // m^2/s^2
  long breaks = 0;        // of bonds since ranks share the specimen, up to the step before
};

class Exchange {
public:
  virtual ~Exchange() = default;
  virtual int ranks() const = 0;
  virtual const OwnBlocks &blocks() const = 0;

  // A step, in this order. Position and motion of particles that other ranks need, after the drift.
  virtual void send_motion(const Particles &particles) = 0;
  virtual void start_sums(const StepSums &own) = 0;
  virtual void receive_motion(Particles &particles) = 0;
  virtual StepSums finish_sums() = 0;
  // Gives what is under way a chance to go on: large messages do only while both sides ask.
  virtual void progress() = 0;
  // What pairs of own blocks exert on particles of other ranks: of bonds once outer blocks are done; of
  // contacts once all are.
  virtual void send_bond_ghosts(const PairBlocks &blocks) = 0;
  virtual void send_contact_ghosts(const PairBlocks &blocks) = 0;
  // Puts what others have sent behind the own ghosts. Null: there are none of that kind.
  virtual void receive_ghosts(PairBlocks *bonds, PairBlocks *contacts) = 0;

  // Bytes to each rank, in a step: what all have sent, this one too, in the order of ranks. No rank sends
  // more than `most`, which all know.
  virtual void send_to_all(const std::vector<char> &bytes, std::size_t most) = 0;
  struct Received {
    const char *data = nullptr; // until the next send_to_all()
    std::size_t count = 0;
  };
  virtual std::vector<Received> receive_from_all() = 0;
  // The same at once, one after the other.
  virtual std::vector<char> all_bytes(const std::vector<char> &own) = 0;

  // Motion of all particles on all ranks, as it is now.
  virtual void gather_motion(Particles &particles) = 0;
  // After contacts were searched anew: whose particles are needed from now on.
  virtual void renew_contacts(Model &model) = 0;
  // Rows that all ranks see in every step from now on, ascending; null: all rows.
  virtual void share_rows(const std::vector<int> *rows) = 0;

  // Breaks of all ranks, by time and number of the bond.
  virtual std::vector<Crack> all_cracks(const std::vector<Crack> &own) = 0;
  virtual ExactSum all(ExactSum own) = 0;
  virtual long all(long own) = 0;     // their sum
  virtual long largest(long own) = 0; // of all ranks

  // Something of so many bytes for each block of particles: every rank gives that of its own blocks and has
  // all.
  virtual void gather_blocks(void *of_blocks, std::size_t bytes) = 0;
  // Sums of the model that each rank has a part of: the first one has them all, the others nothing.
  virtual void sum_up(Model &model) = 0;
  // Tables as they were on one rank: every rank has all rows; and back to the own ones.
  virtual void gather(Model &model) = 0;
  virtual void scatter(Model &model) = 0;
};

} // namespace platen::dem
