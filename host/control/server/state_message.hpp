// The state message (docs/reference/api.md) from what the arm reports and what the service knows.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "host/base/event/event.hpp"
#include "host/base/json/json.hpp"
#include "host/control/server/arm_server.hpp"
#include "host/control/server/emergency_stop.hpp"
#include "host/control/server/owner.hpp"
#include "host/control/server/tip_tool.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::server {

// What the service adds to the arm's own report.
struct Notes {
  Json step = nullptr;           // announced by the mission
  Json operator_says = nullptr;  // with the tick
  Json mission_control = nullptr;
  LastVerdict verdict{};
  std::int64_t verdict_us = 0;  // arm time at which it was given
  std::uint64_t refusals = 0, refused_motions = 0;
  config::DriveNames drive_names;
  std::vector<realtime::BootProblem> boot_problems;  // faults of drives that did not boot
  EmergencyStop stop;
  TipTool tool;
  bool stopping = false;
  std::string enabling_waits;            // for which cables or drives; empty: not for long yet
  std::vector<std::uint32_t> serials;    // of the drives, once they are booted
  std::optional<std::uint32_t> tick_us;  // longest tick of the last command interval; nothing in virtual time
};

// Name of the operating state in the API.
const char* state_name(const ArmServer& desk);

// The whole message; `events`: those it shows.
Json state_message(const config::BusesConfig& buses, const ArmServer& desk, const Owner& owner, const Notes& notes,
                   const std::deque<event::Event>& events);

}  // namespace liana::server
