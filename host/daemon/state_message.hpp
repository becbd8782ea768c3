// The state message (docs/api.md) from what the arm reports and what the service knows.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "host/arbiter/cable_arbiter.hpp"
#include "host/config/config.hpp"
#include "host/control/boot_problem.hpp"
#include "host/control/link.hpp"
#include "host/daemon/emergency_stop.hpp"
#include "host/daemon/owner.hpp"
#include "host/json/json.hpp"
#include "host/verify/verdict.hpp"

namespace liana {

// How the last candidate fared.
struct LastVerdict {
  std::uint64_t sequence = 0;
  bool released = false;
  Verdict worst{};                      // the refusing end, or the tighter margin
  cable::ThetaVector twin_theta_rad{};  // predicted at the end of the candidate's interval
};

// Of what the shape was asked for last (shape_progress.hpp).
struct ShapeNotes {
  double missing_m = 0.0;
  bool settled = true;
  bool searching = false;
};

// What the service adds to the arm's own report.
struct Notes {
  static constexpr std::size_t kKeptEvents = 10;
  Json step = nullptr;           // announced by the mission
  Json operator_says = nullptr;  // with the tick
  std::deque<Json> events;       // newest last, at most kKeptEvents
  LastVerdict verdict{};
  std::uint64_t refusals = 0;
  std::vector<BootProblem> boot_problems;  // faults of drives that did not boot
  EmergencyStop stop;
  bool stopping = false;
  ShapeNotes shape{};
  bool homed = false;                  // homing.hpp
  std::vector<std::uint32_t> serials;  // of the drives, once they are booted
  std::int32_t planar_segments = 0;    // how many the slit asks for now (host/solve/dof_split.hpp)
};

// Name of the operating state in the API.
const char* state_name(const CycleReport& report);

// Angles as degrees, the first theta_count of them.
Json degrees(const cable::RobotTable& table, const cable::ThetaVector& theta_rad);

// The whole message.
Json state_message(const cable::RobotTable& table, const BusesConfig& buses, const CycleReport& report,
                   const CableArbiter& arbiter, const Owner& owner, const Notes& notes);

}  // namespace liana
