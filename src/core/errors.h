// The kinds of failure that are kept apart (docs/notation.md, "Failures"):
//   wrong program    -> assert
//   wrong input      -> InputError, one line, exit code 2
//   wrong numbers    -> a value (status and message), never an exception; exit code 3
//   the user's Ctrl-C -> the program ends at once, exit code 1 (src/app/main.cpp)
#pragma once

#include <stdexcept>
#include <string>

namespace knotlight {

// Exit codes of the program.
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,
  exit_bad_input = 2,
  exit_untrusted = 3,
};

// Something the user gave is wrong. what() is one line: "file:line: key: what is wrong, expected
// ...".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace knotlight
