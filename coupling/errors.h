// Why an experiment cannot be made, or cannot go on. Texts name members of the settings in backquotes
// (`loading.ramp`), which a program that reads them from a file replaces by its own names.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace platen::coupling {

// The run cannot go on: what, where, when and what to try. Apps exit with status 3.
class NumericsStopped : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// The settings ask for something that cannot be run: what is wrong with which member. Apps exit with status
// 2.
class BadSetup : public std::runtime_error {
public:
  BadSetup(std::string member, const std::string &reason)
      : std::runtime_error("`" + member + "` " + reason), member_(std::move(member)), reason_(reason) {}
  const std::string &member() const { return member_; } // "loading.ramp"
  const std::string &reason() const { return reason_; } // what() without the member

private:
  std::string member_, reason_;
};

} // namespace platen::coupling
