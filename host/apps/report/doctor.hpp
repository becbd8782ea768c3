// What a host must offer to Liana, tried one by one.
#pragma once

#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::report {

// One thing looked at: whether it is as Liana wants it, what was found, what it is for, and what to do when it is not.
struct Finding {
  std::string name;
  bool good = false;
  std::string found;
  std::string meaning;
  std::string action;  // what to do; empty when good
};

// What --time real asks of the machine: privileges, kernel, clock, processors. Privileges are tried, and given back.
std::vector<Finding> examine_realtime();

// Looks at real-time privileges, kernel, memory locking, clock, processors, CAN and the test tools. Changes nothing.
std::vector<Finding> examine_host();

// The findings as a JSON list of objects with the names above.
Json findings_json(const std::vector<Finding>& findings);

}  // namespace liana::report
