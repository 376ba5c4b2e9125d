// Whether two parts hold the same to the last bit; where they do not, what differs first, by name and row.
#pragma once

#include <gtest/gtest.h>

#include "base/state.h"

namespace platen {

inline testing::AssertionResult same_state(const State &expected, const State &came) {
  const std::optional<std::string> difference = first_difference(expected, came);
  return difference ? testing::AssertionFailure() << "expected and came: " << *difference
                    : testing::AssertionSuccess();
}
template <class Part>
testing::AssertionResult same_state(const Part &expected, const Part &came) {
  return same_state(state_of(expected), state_of(came));
}
template <class Part>
testing::AssertionResult same_state(const State &expected, const Part &came) {
  return same_state(expected, state_of(came));
}

// A state with these rows in the block of that name, which holds the same kind of rows.
template <class T>
State with_rows(const State &state, const std::string &block_name, const std::vector<T> &rows) {
  State other;
  for (const std::string &name : state.names()) {
    const StoredBlock block = *state.find(name);
    std::vector<char> bytes(block.rows * block.type.bytes_per_row());
    if (!bytes.empty()) state.read(name, bytes.data());
    if (name == block_name)
      other.add(name, block.type, rows.data(), rows.size() * sizeof(T) / block.type.bytes_per_row());
    else
      other.add(name, block.type, bytes.data(), block.rows);
  }
  return other;
}

// A state without the blocks whose names hold this text.
inline State without(const State &state, const std::string &text) {
  State rest;
  for (const std::string &name : state.names()) {
    if (name.find(text) != std::string::npos) continue;
    const StoredBlock block = *state.find(name);
    std::vector<char> bytes(block.rows * block.type.bytes_per_row());
    if (!bytes.empty()) state.read(name, bytes.data());
    rest.add(name, block.type, bytes.data(), block.rows);
  }
  return rest;
}

} // namespace platen
