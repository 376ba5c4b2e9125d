// Positions of the rows of each rank in the state of the whole model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/block_type.h"
#include "dist/rank_file.h"

namespace platen::dem {
class Model;
}

namespace platen::dist {

class Ranks;

// Columns of particles that a step changes: a rank has its own rows. Other columns are complete on all.
bool is_moving(const std::string &column);

// Rows of a block of a state on one rank.
struct SpreadRows {
  struct Run {
    std::size_t own, global, count; // first row here, first row among those of all ranks, number of rows
  };
  std::size_t global = 0; // rows of all ranks
  std::vector<Run> runs;  // of this one, ascending

  // This rank's pieces of the bytes of the complete block; its rows begin at `data` here.
  std::vector<FilePiece> pieces(const void *data, std::size_t bytes_per_row) const;
};

// Rows of a cut model in its current state, after settle_state(). Blocks have the names of Model::describe.
class SpreadState {
public:
  // Collective. `name` is that of the model's part in the state, with a slash: "test/specimen/".
  SpreadState(const Ranks &ranks, dem::Model &model, std::string name);

  // Null: the block is complete on rank 0.
  const SpreadRows *rows_of(const std::string &block) const;
  // The number of rows of a table, which a block of its own contains; none for any other block.
  std::optional<std::uint64_t> table_size_in(const std::string &block) const;

private:
  std::string name_;
  SpreadRows particles_;
  std::map<std::string, SpreadRows> tables_, lists_; // by name
};

} // namespace platen::dist
