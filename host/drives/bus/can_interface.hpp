// Opening a CAN interface of the kernel, with messages that say what is missing.
#pragma once

#include <string>
#include <vector>

namespace liana::bus {

// Names of the CAN interfaces this machine has, sorted.
std::vector<std::string> can_interfaces();

// A non-blocking raw CAN socket bound to `name`: classical frames of others and error frames, own frames not echoed
// back. Throws std::runtime_error naming what is missing (CAN in the kernel, the interface, its state, its transmit
// queue) and what to do.
int open_can_interface(const std::string& name);

}  // namespace liana::bus
