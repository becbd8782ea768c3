// Everything that crosses between the real-time side and the service side. Lock-free, fixed size.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "host/bus/drive_bus.hpp"
#include "host/control/latency_histogram.hpp"
#include "host/control/latest_value.hpp"
#include "host/control/spsc_ring.hpp"
#include "host/record/tick_packet.hpp"
#include "host/verify/twin.hpp"

namespace liana {

enum class BootPhase : std::uint8_t { kBooting = 0, kDone = 1, kFailed = 2 };

// Deadlines that were missed, by cause.
struct Overruns {
  std::uint64_t late_wake = 0;   // the thread came late to its deadline
  std::uint64_t long_tick = 0;   // the tick itself took too long
  std::uint64_t bus_wait = 0;    // the bus kept the thread waiting
  std::uint64_t lost_ticks = 0;  // periods skipped because of them
  std::uint64_t total() const { return late_wake + long_tick + bus_wait; }
  // Those since `before` was taken.
  Overruns since(const Overruns& before) const {
    return {late_wake - before.late_wake, long_tick - before.long_tick, bus_wait - before.bus_wait,
            lost_ticks - before.lost_ticks};
  }
};

// What the real-time side reports after every tick.
struct CycleReport {
  std::uint64_t next_tick = 0;  // ticks done so far
  BootPhase boot = BootPhase::kBooting;
  Inputs inputs{};
  Outputs outputs{};
  Overruns overruns{};
  std::array<DriveBusStats, kMaxDriveBuses> bus{};
  std::uint64_t records_lost = 0;  // tick records that found the ring full
};

struct Link {
  explicit Link(const RobotTable& table)
      : image(TwinImage{0, true, Controller(table), {}, {}}), report(CycleReport{}) {}

  // Service to real time.
  SpscRing<Telecommand, 16> released;
  SpscRing<Request, 16> requests;
  // Real time to service.
  SpscRing<TickRecord, 512> ticks;
  LatestValue<TwinImage> image;     // at the start of each command interval
  LatestValue<CycleReport> report;  // after each tick
  TickTiming timing;
};

}  // namespace liana
