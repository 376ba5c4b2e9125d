// The messages of a step.
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "base/clock.h"
#include "dem/model.h"
#include "dist/ranks.h"

namespace platen::dist {
namespace {

constexpr int loads_tag = 14;

void put(std::vector<double> &to, const Vector3 &v) {
  to.insert(to.end(), {v.x, v.y, v.z});
}

Vector3 vector_at(const double *from) {
  return {from[0], from[1], from[2]};
}

} // namespace

// Posts a receive of at most `most` doubles from each rank; none where that is 0.
void Ranks::post(Messages &messages, const std::vector<std::size_t> &most) {
  messages.receiving.clear();
  messages.from.clear();
  for (std::size_t r = 0; r < most.size(); ++r) {
    if (most[r] == 0) continue;
    messages.in[r].resize(most[r]);
    messages.receiving.emplace_back();
    messages.from.push_back(static_cast<int>(r));
    MPI_Irecv(messages.in[r].data(), static_cast<int>(most[r]), MPI_DOUBLE, static_cast<int>(r), messages.tag,
              ranks_, &messages.receiving.back());
  }
}

void Ranks::send(Messages &messages, int to) {
  const std::vector<double> &out = messages.out[static_cast<std::size_t>(to)];
  messages.sending.emplace_back();
  MPI_Isend(out.data(), static_cast<int>(out.size()), MPI_DOUBLE, to, messages.tag, ranks_,
            &messages.sending.back());
  ++traffic_.messages;
  traffic_.bytes += static_cast<double>(out.size() * sizeof(double));
}

void Ranks::finish_sends(Messages &messages) {
  MPI_Waitall(static_cast<int>(messages.sending.size()), messages.sending.data(), MPI_STATUSES_IGNORE);
  messages.sending.clear();
}

void Ranks::finish_receives(Messages &messages) {
  const auto start = Clock::now();
  MPI_Waitall(static_cast<int>(messages.receiving.size()), messages.receiving.data(), MPI_STATUSES_IGNORE);
  messages.receiving.clear();
  traffic_.waited += seconds_since(start);
}

void Ranks::send_motion(const dem::Particles &p) {
  ++traffic_.steps;
  std::vector<std::size_t> most(motion_from_.size()), most_ghosts(bonds_from_.size());
  for (std::size_t r = 0; r < most.size(); ++r) {
    most[r] = motion_from_[r].size() * doubles_of_motion();
    most_ghosts[r] = bonds_from_[r].size() * doubles_of_ghost();
  }
  post(motion_, most);
  post(bonds_, most_ghosts);
  finish_sends(motion_);
  for (std::size_t r = 0; r < motion_to_.size(); ++r) {
    if (motion_to_[r].empty()) continue;
    std::vector<double> &out = motion_.out[r];
    out.resize(motion_to_[r].size() * doubles_of_motion());
    double *to = out.data();
    for (const int row : motion_to_[r]) {
      std::memcpy(to, &p.position[row], sizeof(Vector3));
      std::memcpy(to + 3, &p.velocity[row], sizeof(Vector3));
      if (rotation_) {
        std::memcpy(to + 6, &(*p.angular_velocity)[row], sizeof(Vector3));
        std::memcpy(to + 9, &(*p.orientation)[row], sizeof(Quaternion));
      }
      to += doubles_of_motion();
    }
    send(motion_, static_cast<int>(r));
  }
}

void Ranks::receive_motion(dem::Particles &p) {
  finish_receives(motion_);
  for (const int r : motion_.from) {
    const double *from = motion_.in[static_cast<std::size_t>(r)].data();
    for (const int row : motion_from_[static_cast<std::size_t>(r)]) {
      p.position[row] = vector_at(from);
      p.velocity[row] = vector_at(from + 3);
      if (rotation_) {
        (*p.angular_velocity)[row] = vector_at(from + 6);
        (*p.orientation)[row] = {from[9], from[10], from[11], from[12]};
      }
      from += doubles_of_motion();
    }
  }
}

// Indices of the ghosts sent to other ranks in the current blocks; -1: the ghost's bonds have broken.
void Ranks::find_ghosts(const dem::PairBlocks &blocks) {
  if (blocks.cut_number() == cut_number_) return;
  cut_number_ = blocks.cut_number();
  for (std::size_t r = 0; r < bond_ghosts_.size(); ++r) {
    index_of_ghost_[r].clear();
    for (const Ghost &ghost : bond_ghosts_[r])
      index_of_ghost_[r].push_back(blocks.ghost_of(ghost.block, ghost.particle));
  }
}

void Ranks::send_bond_ghosts(const dem::PairBlocks &blocks) {
  find_ghosts(blocks);
  finish_sends(bonds_);
  for (std::size_t r = 0; r < bond_ghosts_.size(); ++r) {
    if (bond_ghosts_[r].empty()) continue;
    std::vector<double> &out = bonds_.out[r];
    out.clear();
    for (const int ghost : index_of_ghost_[r]) {
      put(out, ghost < 0 ? Vector3{} : blocks.ghost_force[static_cast<std::size_t>(ghost)]);
      if (rotation_) put(out, ghost < 0 ? Vector3{} : blocks.ghost_torque[static_cast<std::size_t>(ghost)]);
    }
    send(bonds_, static_cast<int>(r));
  }
}

// Few near pairs touch: sends only those, each with its index in the list that both ranks have.
void Ranks::send_contact_ghosts(const dem::PairBlocks &blocks) {
  std::vector<std::size_t> most(contacts_from_.size());
  for (std::size_t r = 0; r < most.size(); ++r)
    most[r] = contacts_from_[r].size() * (1 + doubles_of_ghost());
  post(contacts_, most);
  finish_sends(contacts_);
  for (std::vector<double> &out : contacts_.out)
    out.clear();
  for (const int block : blocks_.all)
    for (std::size_t g = blocks.first_ghost[static_cast<std::size_t>(block)];
         g < blocks.first_ghost[static_cast<std::size_t>(block) + 1]; ++g) {
      const int row = blocks.ghost_particle[g], owner = owner_of(row);
      if (owner == rank_) continue;
      const Vector3 force = blocks.ghost_force[g], torque = rotation_ ? blocks.ghost_torque[g] : Vector3{};
      if (norm_squared(force) == 0 && norm_squared(torque) == 0) continue;
      const std::vector<Ghost> &list = contact_ghosts_[static_cast<std::size_t>(owner)];
      const auto at =
          std::lower_bound(list.begin(), list.end(), Ghost{block, row}, [](const Ghost &a, const Ghost &b) {
            return a.block != b.block ? a.block < b.block : a.particle < b.particle;
          });
      if (at == list.end() || at->block != block || at->particle != row)
        throw std::logic_error("a contact reaches a particle that no list has");
      std::vector<double> &out = contacts_.out[static_cast<std::size_t>(owner)];
      out.push_back(static_cast<double>(at - list.begin()));
      put(out, force);
      if (rotation_) put(out, torque);
    }
  for (std::size_t r = 0; r < contact_ghosts_.size(); ++r)
    if (!contact_ghosts_[r].empty()) send(contacts_, static_cast<int>(r));
}

void Ranks::send_to_all(const std::vector<char> &bytes, std::size_t most) {
  MPI_Waitall(static_cast<int>(sending_loads_.size()), sending_loads_.data(), MPI_STATUSES_IGNORE);
  own_loads_.assign(bytes.begin(), bytes.end());
  loads_.resize(static_cast<std::size_t>(size_));
  receiving_loads_.assign(static_cast<std::size_t>(size_), MPI_REQUEST_NULL);
  sending_loads_ = receiving_loads_;
  for (int r = 0; r < size_; ++r) {
    if (r == rank_) continue;
    const std::size_t k = static_cast<std::size_t>(r);
    if (loads_[k].size() < most) loads_[k].resize(most);
    MPI_Irecv(loads_[k].data(), static_cast<int>(most), MPI_BYTE, r, loads_tag, ranks_, &receiving_loads_[k]);
    MPI_Isend(own_loads_.data(), static_cast<int>(own_loads_.size()), MPI_BYTE, r, loads_tag, ranks_,
              &sending_loads_[k]);
    ++traffic_.messages;
    traffic_.bytes += static_cast<double>(own_loads_.size());
  }
}

std::vector<dem::Exchange::Received> Ranks::receive_from_all() {
  const auto start = Clock::now();
  std::vector<MPI_Status> status(receiving_loads_.size());
  MPI_Waitall(static_cast<int>(status.size()), receiving_loads_.data(), status.data());
  traffic_.waited += seconds_since(start);
  std::vector<Received> all;
  for (int r = 0; r < size_; ++r) {
    const std::size_t k = static_cast<std::size_t>(r);
    int count = static_cast<int>(own_loads_.size());
    if (r != rank_) MPI_Get_count(&status[k], MPI_BYTE, &count);
    all.push_back({(r == rank_ ? own_loads_ : loads_[k]).data(), static_cast<std::size_t>(count)});
  }
  return all;
}

void Ranks::receive_ghosts(dem::PairBlocks *bonds, dem::PairBlocks *contacts) {
  const auto take = [&](dem::PairBlocks &blocks, std::size_t ghost, const double *from) {
    blocks.ghost_force[ghost] = vector_at(from);
    if (rotation_) blocks.ghost_torque[ghost] = vector_at(from + 3);
  };
  if (bonds != nullptr) {
    finish_receives(bonds_);
    std::size_t ghost = bonds->own_ghosts();
    for (std::size_t r = 0; r < bonds_from_.size(); ++r)
      for (std::size_t k = 0; k < bonds_from_[r].size(); ++k)
        take(*bonds, ghost++, bonds_.in[r].data() + k * doubles_of_ghost());
  }
  if (contacts == nullptr) return;
  const auto start = Clock::now();
  std::vector<MPI_Status> status(contacts_.receiving.size());
  MPI_Waitall(static_cast<int>(status.size()), contacts_.receiving.data(), status.data());
  traffic_.waited += seconds_since(start);
  const std::size_t first_remote = contacts->own_ghosts();
  std::fill(contacts->ghost_force.begin() + static_cast<std::ptrdiff_t>(first_remote),
            contacts->ghost_force.end(), Vector3{});
  if (rotation_)
    std::fill(contacts->ghost_torque.begin() + static_cast<std::ptrdiff_t>(first_remote),
              contacts->ghost_torque.end(), Vector3{});
  std::vector<std::size_t> first(contacts_from_.size(), first_remote);
  for (std::size_t r = 1; r < first.size(); ++r)
    first[r] = first[r - 1] + contacts_from_[r - 1].size();
  for (std::size_t k = 0; k < status.size(); ++k) {
    const std::size_t r = static_cast<std::size_t>(contacts_.from[k]);
    int doubles = 0;
    MPI_Get_count(&status[k], MPI_DOUBLE, &doubles);
    for (int d = 0; d < doubles; d += static_cast<int>(1 + doubles_of_ghost())) {
      const double *from = contacts_.in[r].data() + d;
      take(*contacts, first[r] + static_cast<std::size_t>(from[0]), from + 1);
    }
  }
  contacts_.receiving.clear();
}

} // namespace platen::dist
