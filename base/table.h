// A table of named columns, all of one length. Particles, bonds and contacts are tables, so that sorting,
// resizing, checkpoints and output are written once for every present and future column.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/allowed.h"
#include "base/block_type.h"

namespace platen {

class ColumnBase {
public:
  ColumnBase(std::string name, std::string unit) : name_(std::move(name)), unit_(std::move(unit)) {}
  virtual ~ColumnBase() = default;
  const std::string &name() const { return name_; }
  const std::string &unit() const { return unit_; } // SI, e.g. "m/s"; "1" where there is none
  virtual std::size_t size() const = 0;
  virtual void resize(std::size_t n) = 0;
  // Row k becomes the former row order[k]; order may be shorter than the column (gather). `reserve`: number
  // of further rows for which memory is allocated.
  virtual void permute(const std::vector<int> &order, std::size_t reserve) = 0;
  // The same within the rows from `first` on: row first + k becomes the former row first + order[k].
  virtual void permute_from(std::size_t first, const std::vector<int> &order) = 0;
  virtual BlockType type() const = 0;
  virtual std::size_t bytes_per_row() const = 0;
  virtual void *bytes() = 0;
  virtual const void *bytes() const = 0;
  // For a column that older states lack: whether it has a default value, and a function that sets all rows to
  // it.
  virtual bool may_lack() const = 0;
  virtual void fill_lacking() = 0;
  // Allowed numbers in a state that is read.
  const Allowed &allowed() const { return allowed_; }
  void allow(const Allowed &allowed) { allowed_ = allowed; }

private:
  std::string name_, unit_;
  Allowed allowed_;
};

template <class T>
class Column : public ColumnBase {
  static_assert(std::is_trivially_copyable_v<T>, "columns are saved and sorted as plain bytes");

public:
  Column(std::string name, std::string unit, std::optional<T> lacking = std::nullopt)
      : ColumnBase(std::move(name), std::move(unit)), lacking_(lacking) {}
  T *data() { return values_.data(); }
  const T *data() const { return values_.data(); }
  T &operator[](std::size_t k) { return values_[k]; }
  const T &operator[](std::size_t k) const { return values_[k]; }
  typename std::vector<T>::iterator begin() { return values_.begin(); }
  typename std::vector<T>::iterator end() { return values_.end() - spare; }
  typename std::vector<T>::const_iterator begin() const { return values_.begin(); }
  typename std::vector<T>::const_iterator end() const { return values_.end() - spare; }
  std::size_t size() const override { return values_.size() - spare; }
  void resize(std::size_t n) override {
    values_.resize(n + spare);
    values_[n] = T{};
  }
  void permute(const std::vector<int> &order, std::size_t reserve) override {
    std::vector<T> moved;
    moved.reserve(order.size() + reserve + spare);
    moved.resize(order.size() + spare);
    for (std::size_t k = 0; k < order.size(); ++k)
      moved[k] = values_[order[k]];
    values_.swap(moved);
  }
  void permute_from(std::size_t first, const std::vector<int> &order) override {
    std::vector<T> moved(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      moved[k] = values_[first + static_cast<std::size_t>(order[k])];
    std::copy(moved.begin(), moved.end(), values_.begin() + static_cast<std::ptrdiff_t>(first));
  }
  BlockType type() const override { return block_type<T>(unit()); }
  std::size_t bytes_per_row() const override { return sizeof(T); }
  void *bytes() override { return values_.data(); }
  const void *bytes() const override { return values_.data(); }
  bool may_lack() const override { return lacking_.has_value(); }
  void fill_lacking() override {
    for (T &value : *this)
      value = *lacking_;
  }

private:
  // One row beyond the end, so that kernels may read a vector of three doubles as four.
  static constexpr std::size_t spare = 1;
  std::vector<T> values_ = std::vector<T>(spare);
  std::optional<T> lacking_;
};

class Table {
public:
  // Adds a column of the table's length. The reference stays valid for the life of the table. `lacking`: the
  // value of its rows for older states without this column; without a value such a state is refused.
  template <class T>
  Column<T> &add(const std::string &name, const std::string &unit, std::optional<T> lacking = std::nullopt) {
    auto column = std::make_unique<Column<T>>(name, unit, lacking);
    column->resize(size_);
    Column<T> &reference = *column;
    columns_.push_back(std::move(column));
    return reference;
  }
  // A column whose allowed numbers are not just all finite ones.
  template <class T>
  Column<T> &add(const std::string &name, const std::string &unit, const Allowed &allowed,
                 std::optional<T> lacking = std::nullopt) {
    Column<T> &column = add<T>(name, unit, lacking);
    column.allow(allowed);
    return column;
  }
  std::size_t size() const { return size_; }
  void resize(std::size_t n) {
    for (auto &column : columns_)
      column->resize(n);
    size_ = n;
  }
  void permute(const std::vector<int> &order, std::size_t reserve = 0) {
    for (auto &column : columns_)
      column->permute(order, reserve);
    size_ = order.size();
  }
  void permute_from(std::size_t first, const std::vector<int> &order) {
    for (auto &column : columns_)
      column->permute_from(first, order);
  }
  std::size_t bytes_per_row() const {
    std::size_t sum = 0;
    for (const auto &column : columns_)
      sum += column->bytes_per_row();
    return sum;
  }
  const std::vector<std::unique_ptr<ColumnBase>> &columns() const { return columns_; }

private:
  std::size_t size_ = 0;
  std::vector<std::unique_ptr<ColumnBase>> columns_;
};

} // namespace platen
