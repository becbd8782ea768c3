#include "host/control/realtime/rt_cycle.hpp"

#include "host/control/realtime/tick_guard.hpp"

namespace liana::realtime {

template <class Arm>
RtCycle<Arm>::RtCycle(const typename Arm::Table& table, const std::vector<canopen::ExpectedDrive>& drives,
                      const config::BusesConfig& buses, bus::DriveBus& bus, ArmMailbox<Arm>& link)
    : bus_(bus),
      line_(drives, buses, bus),
      times_(buses.period_us(), link.timing),
      core_(table, link),
      link_(link),
      interval_ticks_(static_cast<std::uint64_t>(table.interval_ticks)) {}

template <class Arm>
bool RtCycle<Arm>::run_tick() noexcept {
  const timing::TickStart start = bus_.begin_tick(report_.next_tick);  // the deadline
  if (start.ended) return false;
  const TickGuard nothing_allocates_from_here;
  times_.begin(start, bus_.now_us(), report_.overruns);
  bus_.write_sync();  // drives act on the targets of the last tick, and sample
  bus_.wait_feedback(line_.drive_count());
  times_.heard(bus_.now_us());
  line_.collect(start, report_.inputs);  // TPDOs, heartbeats, emergencies: the inputs of this tick
  step_sensors(start);                   // wrist sensor and adapter, or load cells
  line_.step_master();                   // heartbeat out; while booting, the next SDO requests
  step_core();
  bus_.end_tick();
  finish_tick(start);  // what the service side sees
  times_.end(start, bus_.now_us());
  return true;
}

template <class Arm>
void RtCycle<Arm>::step_sensors(const timing::TickStart& start) noexcept {
  if constexpr (std::is_same_v<typename Arm::Sensors, serial::Sensors>) {
    report_.inputs.sensors = line_.sensor_channel().sensors();
    const AdapterOrder order = link_.adapter.load(std::memory_order_acquire);
    line_.step_sensors(start.tick, order.command, order.sequence);
  } else {
    report_.inputs.sensors = line_.sensor_channel().load_cells();
    line_.step_sensors(start.tick, {}, 0);
  }
}

// A clear waits until the drives that were lost are booted again; without power nobody moves meanwhile. Drives that
// have not booted have no Controller yet: they are only asked for again.
template <class Arm>
void RtCycle<Arm>::step_core() noexcept {
  const OperatingState state = report_.outputs.state;
  const bool is_off = state == OperatingState::kDisabled || state == OperatingState::kFault;
  const bool waits = core_.next_request() == Request::kClear && is_off && !line_.reboot_lost_drives(report_.inputs);
  if (report_.boot == BootPhase::kDone) return line_.command(core_.step(report_.inputs, waits).drive);
  core_.drop_request();
}

// The Controller starts at the beginning of a command interval, so that recordings and twin images start there, too.
template <class Arm>
void RtCycle<Arm>::finish_tick(const timing::TickStart& start) noexcept {
  report_.next_tick = start.tick + 1;
  if (report_.boot != BootPhase::kDone && report_.next_tick % interval_ticks_ == 0) report_.boot = line_.boot_phase();
  for (int b = 0; b < bus_.bus_count(); ++b) report_.bus[static_cast<std::size_t>(b)] = bus_.stats(b);
  core_.publish(report_);
}

template class RtCycle<cable::CableArm>;
template class RtCycle<serial::SerialArm>;

}  // namespace liana::realtime
