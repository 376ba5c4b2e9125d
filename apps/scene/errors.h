// The kinds of failure that differ in the exit status of an app (docs: exit status of the apps).
#pragma once

#include <stdexcept>

namespace platen::apps {

// Exit statuses of every app.
constexpr int status_done = 0, status_check_failed = 1, status_bad_input = 2, status_numerics = 3,
              status_output = 4;

// Bad command line, scene or file named by them, found before anything was written: exit status 2. The text
// names file, line, key, value and what is allowed, in at most six lines for each fault.
class InputError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// The numerics stopped during a run: exit status 3. The text says where, when and what to try.
class NumericsError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// Reading or writing failed during a run: exit status 4.
class OutputError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// Why a text is no value: a predicate that goes after the text, e.g. `is not a number`.
class ValueError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace platen::apps
