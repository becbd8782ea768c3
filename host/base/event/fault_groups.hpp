// Faults as people read them: those of one kind in one line, with the drives and buses that have them.
#pragma once

#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::event {

struct FaultGroup {
  int number = 0;
  std::string name;
  int detail = 0;
  std::vector<std::string> places;  // drives or buses
  std::string text, remedy;
  std::vector<FaultGroup> follows;  // consequences, which the cause's remedy ends; without any of their own

  // "3002 drive_silent: drives 4 (node 4, segment 2) and 5 (node 5, segment 2)", then " (detail 16)" where it has one.
  std::string title() const;
  // The same, then " and 3 consequences" where it has some: one alarm.
  std::string alarm() const;
};

// One text for places such as drives: "drives 4 (node 4, segment 2) and 5 (node 5, segment 2)"; of more than three
// drives the numbers only: "drives 1, 2, 3 and 4".
std::string places_text(const std::vector<std::string>& places);

// `faults`: of the state message. Causes in their order, each with what follows from it; equal number, detail and text
// make one group.
std::vector<FaultGroup> fault_groups(const Json& faults);

}  // namespace liana::event
