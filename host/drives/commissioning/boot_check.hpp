// Whether a drive would boot: what its boot would refuse, found by reading, or by a boot whose writes are taken back.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/drives/commissioning/desk.hpp"

namespace liana::commissioning {

struct BootCheck {
  std::unique_ptr<canopen::BootNode> node;  // after the look, or the trial; its mismatches are refusals
  std::vector<std::string> more;          // refusals that reading found beside them, in words without the drive's name
  std::vector<std::string> not_restored;  // after a trial: objects that did not take their old value back
  bool is_watched = true;                 // 6061 is there: a change of its mode would be seen
  bool would_boot() const { return node->mismatches().empty() && more.empty(); }
};

// Reads all that a boot compares and all that its process data map: nothing is written. What only a write shows (access
// rights, and that 6061 follows 6060) stays open.
BootCheck check_by_reading(Desk& desk, const canopen::ExpectedDrive& drive);

// Boots the drive as lianad does, asks for one report, and puts back what it wrote: by a reset of communication, and
// object by object where that does not. Nothing gives it torque.
BootCheck check_by_trial(Desk& desk, const canopen::ExpectedDrive& drive);

}  // namespace liana::commissioning
