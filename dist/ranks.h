// One specimen cut over the ranks of an MPI communicator (docs/clusters.md). Every rank keeps the row numbers
// of the whole specimen and computes its own blocks of 512 rows. Forces of a pair of its blocks on a particle
// of another rank are sent there and added in the order of blocks, as on one rank. So results are the same
// bytes.
//
// A step has three messages to each neighbour: position and motion of the particles that it needs (104 bytes
// per particle with rotation, 48 without), forces of bonds (48, 24), forces of touching contacts (56, 32);
// and one reduction over all ranks, of some 600 bytes.
#pragma once

#include <mpi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dem/exchange.h"
#include "dist/partition.h"

namespace platen {
class Table;
}

namespace platen::dist {

// Data sent in steps by this rank.
struct Traffic {
  long steps = 0, messages = 0;
  double bytes = 0;
  double waited = 0; // s, for messages and reductions
};

class Ranks : public dem::Exchange {
public:
  // Collective. MPI must have been initialised, with MPI_THREAD_FUNNELED or more where there are threads.
  explicit Ranks(MPI_Comm ranks);
  ~Ranks() override;
  Ranks(const Ranks &) = delete;
  Ranks &operator=(const Ranks &) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  MPI_Comm communicator() const { return ranks_; }          // a copy, of its own
  const Partition &partition() const { return partition_; } // set by the first scatter()
  const Traffic &traffic() const { return traffic_; }
  std::size_t halo_rows() const; // of other ranks, sent here in every step
  // Planned traffic of this rank in a step: rows sent to other ranks, times 104 (48 without rotation), ghosts
  // of bonds times 48 (24); up to three messages to each neighbour. Contacts that touch are not included.
  double expected_bytes() const;
  long expected_messages() const;

  int ranks() const override { return size_; }
  const dem::OwnBlocks &blocks() const override { return blocks_; }
  void send_motion(const dem::Particles &particles) override;
  void start_sums(const dem::StepSums &own) override;
  void receive_motion(dem::Particles &particles) override;
  dem::StepSums finish_sums() override;
  void progress() override;
  void send_bond_ghosts(const dem::PairBlocks &blocks) override;
  void send_contact_ghosts(const dem::PairBlocks &blocks) override;
  void receive_ghosts(dem::PairBlocks *bonds, dem::PairBlocks *contacts) override;
  void send_to_all(const std::vector<char> &bytes, std::size_t most) override;
  std::vector<Received> receive_from_all() override;
  std::vector<char> all_bytes(const std::vector<char> &own) override;
  void gather_motion(dem::Particles &particles) override;
  void renew_contacts(dem::Model &model) override;
  void share_rows(const std::vector<int> *rows) override;
  std::vector<dem::Crack> all_cracks(const std::vector<dem::Crack> &own) override;
  ExactSum all(ExactSum own) override;
  long all(long own) override;
  long largest(long own) override;
  void gather_blocks(void *of_blocks, std::size_t bytes) override;
  void sum_up(dem::Model &model) override;
  void gather(dem::Model &model) override;
  void scatter(dem::Model &model) override;

private:
  // A ghost of an own block whose particle belongs to another rank.
  struct Ghost {
    int block = 0, particle = 0;
  };
  // Messages of one kind, to and from each rank.
  struct Messages {
    int tag = 0;
    std::vector<std::vector<double>> out, in; // of each rank
    std::vector<MPI_Request> sending, receiving;
    std::vector<int> from; // rank of each receive
  };
  struct Sums {
    double fastest, not_finite;
    std::int64_t breaks;
    ExactSum::Limbs limbs;
  };

  int owner_of(int row) const;
  bool is_own(int row) const { return owner_of(row) == rank_; }
  void cut(const dem::Model &model);
  void list_blocks(const dem::PairBlocks &bonds);
  void plan_bonds(dem::PairBlocks &blocks);
  void plan_contacts(dem::Model &model);
  void plan_halo(const dem::Model &model);
  void plan_motion();
  void find_ghosts(const dem::PairBlocks &blocks);

  void post(Messages &messages, const std::vector<std::size_t> &most);
  void send(Messages &messages, int to);
  void finish_sends(Messages &messages);
  void finish_receives(Messages &messages);
  std::size_t doubles_of_motion() const { return rotation_ ? 13 : 6; }
  std::size_t doubles_of_ghost() const { return rotation_ ? 6 : 3; }

  // Gather rows of all ranks in the order of blocks.
  void gather_columns(Table &table, const std::vector<std::int64_t> &rows_of_block);
  void gather_table(Table &table, const int *first, std::size_t rows);
  void gather_particles(dem::Particles &particles);
  template <class Row>
  void gather_list(std::vector<Row> &list);
  std::vector<char> gather_bytes(const void *own, std::size_t width,
                                 const std::vector<std::int64_t> &rows_of_block) const;

  MPI_Comm ranks_;
  int rank_ = 0, size_ = 1;
  Partition partition_;
  dem::OwnBlocks blocks_;
  bool rotation_ = false, is_cut_ = false;
  std::size_t rows_ = 0; // of the specimen

  std::vector<std::vector<Ghost>> bond_ghosts_, contact_ghosts_; // to each rank, by block and particle
  std::vector<std::vector<Ghost>> bonds_from_, contacts_from_;   // from each rank
  std::vector<std::vector<int>> index_of_ghost_;                 // of bonds, in the current blocks
  unsigned cut_number_ = 0;                                      // cut number of the blocks for these indices
  std::vector<std::vector<int>> halo_to_, halo_from_;            // rows, ascending
  std::vector<int> shared_;
  bool share_all_ = false;
  std::vector<std::vector<int>> motion_to_, motion_from_; // halo and shared rows
  Messages motion_, bonds_, contacts_;
  std::vector<std::vector<char>> loads_; // of each rank
  std::vector<char> own_loads_;
  std::vector<MPI_Request> receiving_loads_, sending_loads_;

  MPI_Datatype sums_type_ = MPI_DATATYPE_NULL;
  MPI_Op add_sums_ = MPI_OP_NULL;
  Sums own_sums_{}, all_sums_{};
  MPI_Request summing_ = MPI_REQUEST_NULL;
  Traffic traffic_;
};

} // namespace platen::dist
