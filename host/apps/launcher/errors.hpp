// How a command of `liana` ends.
#pragma once

#include <stdexcept>

namespace liana::launcher {

// Exit codes of `liana`; the same for every command.
enum ExitCode : int {
  kExitOk = 0,
  kExitFailure = 1,
  kExitBadInput = 2,
  kExitNotConverged = 3,
  kExitNothingStopped = 4,
  kExitInterrupted = 130
};

// What the user gave cannot be used: the message says what, the value, what is allowed and what to do. Ends with exit
// code 2.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// An emergency stop that found nothing to stop; the message warns of an arm that moves all the same. Ends with exit
// code 4.
struct NothingStopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Ctrl-C or SIGTERM ended the work before there was a result; the message says what was left undone. Ends with exit
// code 130.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace liana::launcher
