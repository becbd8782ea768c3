// The part of a tick that is the same on every bus: requests and released telecommands in, Controller, reports out.
#pragma once

#include "firmware_like/cable_controller.hpp"
#include "host/control/link.hpp"

namespace liana {

class TickCore {
 public:
  TickCore(const cable::RobotTable& table, Link& link) : controller_(table), link_(link) {}

  // One tick: adds a stop that was pressed, or else the next request, and the telecommand that is due to `inputs`, runs
  // the Controller, and records the tick.
  const cable::Outputs& step(cable::Inputs& inputs);
  // Makes the state after this tick visible to the service; when a command interval has ended, the Controller's image,
  // too.
  void publish(CycleReport& report);

 private:
  cable::Telecommand due_telecommand(std::uint64_t tick);
  Request due_request();

  cable::Controller controller_;
  Link& link_;
  TickRecord record_{};
  std::uint64_t imaged_interval_ = 0;
  std::uint64_t records_lost_ = 0;
  bool fresh_ = true;
};

}  // namespace liana
