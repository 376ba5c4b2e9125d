// Contacts of a boundary whose computation is divided over ranks.
#pragma once

#include <cstddef>
#include <vector>

namespace platen::coupling {

// Every rank has the same rows, computes those of its own particles and gets the results of all.
class SharedContacts {
public:
  // Marks the blocks of particles whose rows this rank computes from now on.
  virtual void compute_only(const std::vector<char> &own_blocks) = 0;
  // Between compute_part() and apply_forces(): appends the loads of the own rows on the body and their sums;
  // then reads what all ranks have appended, one after the other in any order, the own part included.
  virtual std::size_t most_bytes() const = 0; // largest number of bytes of one rank in a step
  virtual void put_loads(std::vector<char> &bytes) const = 0;
  virtual void take_loads(const std::vector<char> &of_all) = 0;
  // The same between steps, for all data of a row: history and contact.
  virtual void put_rows(std::vector<char> &bytes) const = 0;
  virtual void take_rows(const std::vector<char> &of_all) = 0;

protected:
  ~SharedContacts() = default;
};

} // namespace platen::coupling
