// Rows of a contact layer that several ranks compute together: each rank those of its own particles, and all
// get their loads on the body. Summed row by row, as on one rank.
#include <algorithm>
#include <cstring>

#include "base/parallel.h"
#include "coupling/contact/contact_layer.h"

namespace platen::coupling {
namespace {

template <class T>
void put(std::vector<char> &bytes, const T &value) {
  const char *from = reinterpret_cast<const char *>(&value);
  bytes.insert(bytes.end(), from, from + sizeof value);
}

template <class T>
T take(const std::vector<char> &bytes, std::size_t &at) {
  T value;
  std::memcpy(static_cast<void *>(&value), bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}

} // namespace

bool ContactLayer::is_own(std::size_t row) const {
  return own_blocks_.empty() || own_blocks_[static_cast<std::size_t>(particle_[row]) / block_rows];
}

std::size_t ContactLayer::most_bytes() const {
  return table_.size() * sizeof(SharedLoad);
}

void ContactLayer::put_loads(std::vector<char> &bytes) const {
  for (std::size_t k = 0; k < results_.size(); ++k) {
    const RowLoad &l = results_.load[k];
    const RowWork &w = results_.work[k];
    const bool active = l.particle >= 0;
    if (!active && w.friction_loss == 0 && w.damping_loss == 0) continue;
    SharedLoad shared{};
    shared.row = static_cast<int>(due_[k]);
    shared.particle = l.particle;
    shared.friction_loss = w.friction_loss, shared.damping_loss = w.damping_loss;
    shared.depth = w.depth;
    if (active) {
      shared.face = l.face, shared.weights = l.weights;
      shared.force = l.force, shared.point = results_.contact[k].point;
      if (seat_spring_ != nullptr) shared.moment = moments_[k];
      shared.elastic = w.elastic;
    }
    put(bytes, shared);
  }
}

// Own rows stay unchanged: of other rows the torque on the particle and data for output only are not sent.
void ContactLayer::take_loads(const std::vector<char> &of_all) {
  std::vector<SharedLoad> shared(of_all.size() / sizeof(SharedLoad));
  if (!shared.empty()) std::memcpy(static_cast<void *>(shared.data()), of_all.data(), of_all.size());
  std::sort(shared.begin(), shared.end(),
            [](const SharedLoad &a, const SharedLoad &b) { return a.row < b.row; });
  std::vector<std::size_t> rows;
  RowResults results;
  std::vector<Vector3> moments;
  rows.reserve(shared.size());
  for (const SharedLoad &s : shared) {
    const std::size_t row = static_cast<std::size_t>(s.row);
    rows.push_back(row);
    if (seat_spring_ != nullptr) moments.push_back(s.moment);
    if (is_own(row)) {
      const std::size_t k =
          static_cast<std::size_t>(std::lower_bound(due_.begin(), due_.end(), row) - due_.begin());
      results.append(results_.load[k], results_.torque[k], results_.work[k], results_.contact[k]);
      continue;
    }
    results.append({s.particle, s.face, s.force, s.weights}, {},
                   {s.elastic, s.friction_loss, s.damping_loss, s.depth}, {s.point, {}});
  }
  due_ = std::move(rows), results_ = std::move(results);
  moments_ = std::move(moments);
}

void ContactLayer::put_rows(std::vector<char> &bytes) const {
  for (std::size_t row = 0; row < table_.size(); ++row) {
    if (!is_own(row)) continue;
    put(bytes, static_cast<int>(row));
    for (const auto &column : table_.columns()) {
      const char *from = static_cast<const char *>(column->bytes()) + row * column->bytes_per_row();
      bytes.insert(bytes.end(), from, from + column->bytes_per_row());
    }
    const auto due = std::lower_bound(due_.begin(), due_.end(), row);
    const bool found = due != due_.end() && *due == row;
    const std::size_t k = static_cast<std::size_t>(due - due_.begin());
    put(bytes, found ? results_.contact[k] : RowContact{});
    put(bytes, found ? results_.torque[k].normal_force : 0.0);
  }
}

void ContactLayer::take_rows(const std::vector<char> &of_all) {
  for (std::size_t at = 0; at < of_all.size();) {
    const std::size_t row = static_cast<std::size_t>(take<int>(of_all, at));
    for (const auto &column : table_.columns()) {
      const std::size_t width = column->bytes_per_row();
      std::memcpy(static_cast<char *>(column->bytes()) + row * width, of_all.data() + at, width);
      at += width;
    }
    const RowContact contact = take<RowContact>(of_all, at);
    const double normal_force = take<double>(of_all, at);
    const auto due = std::lower_bound(due_.begin(), due_.end(), row);
    if (due == due_.end() || *due != row) continue;
    const std::size_t k = static_cast<std::size_t>(due - due_.begin());
    results_.contact[k] = contact, results_.torque[k].normal_force = normal_force;
  }
}

} // namespace platen::coupling
