#include "apps/scene/rank.h"

#include <chrono>
#include <iostream>
#include <thread>

namespace platen::apps {

Rank &this_rank() {
  static Rank rank;
  return rank;
}

void before_telling_a_failure() {
  constexpr std::chrono::seconds patience{5};
  if (!this_rank().is_silent()) return;
  std::this_thread::sleep_for(patience); // what fails on all is told by the first
  std::cerr << "rank " << this_rank().number << ": ";
}

void after_telling_a_failure(int status) {
  if (this_rank().of == 1) return;
  std::cout.flush();
  std::cerr.flush();
  this_rank().end_all(status);
}

} // namespace platen::apps
