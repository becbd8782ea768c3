// The part of a tick that is the same on every bus: requests and released telecommands in, Controller, reports out.
#pragma once

#include "firmware_like/controller.hpp"
#include "host/control/link.hpp"

namespace liana {

class TickCore {
 public:
  TickCore(const RobotTable& table, Link& link) : controller_(table), link_(link) {}

  // One tick: adds the next request and the telecommand that is due to `inputs`, runs the Controller, and records the
  // tick.
  const Outputs& step(Inputs& inputs);
  // Makes the state after this tick visible to the service; when a command interval has ended, the Controller's image,
  // too.
  void publish(CycleReport& report);

 private:
  Telecommand due_telecommand(std::uint64_t tick);

  Controller controller_;
  Link& link_;
  TickRecord record_{};
  std::uint64_t imaged_interval_ = 0;
  std::uint64_t records_lost_ = 0;
  bool fresh_ = true;
};

}  // namespace liana
