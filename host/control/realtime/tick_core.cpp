#include "host/control/realtime/tick_core.hpp"

namespace liana::realtime {

// The newest telecommand whose time has come; one that is overdue after lost ticks is still taken until it expires.
template <class Arm>
typename TickCore<Arm>::Command TickCore<Arm>::due_telecommand(std::uint64_t tick) {
  Command due;
  while (const Command* next = link_.released.front()) {
    if (next->first_tick() > tick) break;
    if (next->expiry_tick() > tick) due = *next;
    link_.released.pop();
  }
  return due;
}

// A stop overtakes what waits, and voids it: an enable that was asked for before it must not follow it.
template <class Arm>
Request TickCore<Arm>::due_request(bool waits) {
  if (link_.stop.take()) {
    for (std::size_t i = 0; i < kMaxRequests && link_.requests.front() != nullptr; ++i) link_.requests.pop();
    return Request::kStop;
  }
  const Request next = waits ? Request::kNone : next_request();
  if (!waits) drop_request();
  return next;
}

template <class Arm>
Request TickCore<Arm>::next_request() const {
  const Request* const next = link_.requests.front();
  return next == nullptr ? Request::kNone : *next;
}

template <class Arm>
void TickCore<Arm>::drop_request() {
  if (link_.requests.front() != nullptr) link_.requests.pop();
}

template <class Arm>
const Outputs<Arm>& TickCore<Arm>::step(Inputs<Arm>& inputs, bool waits) {
  inputs.telecommand = due_telecommand(inputs.tick);
  inputs.request = due_request(waits);
  record_.inputs = inputs;
  record_.outputs = controller_.tick(inputs);
  fresh_ = false;
  if (!link_.ticks.push(record_)) ++records_lost_;
  return record_.outputs;
}

template <class Arm>
void TickCore<Arm>::publish(ArmTickStatus<Arm>& report) {
  report.outputs = record_.outputs;
  report.records_lost = records_lost_;
  link_.report.publish(report);
  const std::uint64_t interval = report.next_tick / static_cast<std::uint64_t>(controller_.table().interval_ticks);
  if (interval == imaged_interval_) return;
  imaged_interval_ = interval;
  verification::TwinSnapshot<Arm>& image = link_.image.draft();  // filled in place: it is large
  image.next_tick = report.next_tick;
  image.fresh = fresh_;
  image.controller = controller_;
  image.last_inputs = record_.inputs;
  image.last_outputs = record_.outputs;
  link_.image.publish();
}

template class TickCore<cable::CableArm>;
template class TickCore<serial::SerialArm>;

}  // namespace liana::realtime
