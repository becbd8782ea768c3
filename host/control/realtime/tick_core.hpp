// The part of a tick that is the same on every bus: requests and released telecommands in, Controller, reports out.
#pragma once

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/control/realtime/link.hpp"

namespace liana::realtime {

template <class Arm>
class TickCore {
 public:
  TickCore(const typename Arm::Table& table, ArmMailbox<Arm>& link) : controller_(table), link_(link) {}

  // The request that waits longest; kNone when none does.
  Request next_request() const;
  // Without a step: that request is done with.
  void drop_request();
  // One tick: adds a stop that was pressed, or else the next request, unless it `waits`, and the telecommand that is
  // due to `inputs`, runs the Controller, and records the tick.
  const Outputs<Arm>& step(Inputs<Arm>& inputs, bool waits = false);
  // Makes the state after this tick visible to the service; when a command interval has ended, the Controller's image,
  // too.
  void publish(ArmTickStatus<Arm>& report);

 private:
  using Command = Telecommand<typename Arm::Setpoint>;

  Command due_telecommand(std::uint64_t tick);
  Request due_request(bool waits);

  Controller<Arm> controller_;
  ArmMailbox<Arm>& link_;
  recording::TickRecord<Arm> record_{};
  std::uint64_t imaged_interval_ = 0;
  std::uint64_t records_lost_ = 0;
  bool fresh_ = true;
};

extern template class TickCore<cable::CableArm>;
extern template class TickCore<serial::SerialArm>;

}  // namespace liana::realtime
