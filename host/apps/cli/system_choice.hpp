// Which system a command joins: a running one, or a simulated arm of its own.
#pragma once

#include <string>

#include "host/apps/launcher/run_options.hpp"

namespace liana::cli {

struct SystemSelection {
  std::string api;           // empty: the one running system; where there is none, a simulated arm is started
  bool simulate = false;     // a simulated arm is started whatever runs
  launcher::RunOptions run;  // how it is to be, of a simulated arm
};

// The API socket of the running system that is meant; empty: none, a simulated arm is to be started. `command` is the
// name in messages. Throws BadInput where several run, and where something is said about a simulated arm that is none.
std::string system_to_join(const char* command, const SystemSelection& wish);

}  // namespace liana::cli
