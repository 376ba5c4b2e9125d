// Type of the rows of a block of numbers: the same for columns of tables, states in memory and files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

namespace platen {

struct BlockType {
  enum class Kind : std::uint8_t { signed_integer = 1, unsigned_integer = 2, floating = 3, text = 4 };
  Kind kind = Kind::floating;
  std::uint32_t bytes = 8;   // of one number
  std::uint32_t numbers = 1; // of one row
  std::string unit = "1";    // SI, e.g. "m/s"; "1" where there is none

  std::size_t bytes_per_row() const { return std::size_t{bytes} * numbers; }
  bool operator==(const BlockType &b) const {
    return kind == b.kind && bytes == b.bytes && numbers == b.numbers && unit == b.unit;
  }
};

inline BlockType text_type() {
  return {BlockType::Kind::text, 1, 1, "1"};
}

// "8-byte floating-point numbers (m/s), 3 in a row".
std::string describe(const BlockType &type);

// The kind of number that a value consists of. A struct of numbers of one kind without padding declares it
// after its definition: template <> struct NumbersOf<Vector3> { using Number = double; };
template <class T>
struct NumbersOf {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "say what numbers this is made of");
  using Number = T;
};
template <class T, std::size_t n>
struct NumbersOf<std::array<T, n>> {
  using Number = typename NumbersOf<T>::Number;
};

template <class T>
BlockType block_type(std::string unit) {
  using Number = typename NumbersOf<T>::Number;
  using Kind = BlockType::Kind;
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Number) == 0, "plain numbers alone");
  constexpr Kind kind = std::is_floating_point_v<Number> ? Kind::floating
                        : std::is_unsigned_v<Number>     ? Kind::unsigned_integer
                                                         : Kind::signed_integer;
  return {kind, sizeof(Number), sizeof(T) / sizeof(Number), std::move(unit)};
}

} // namespace platen
