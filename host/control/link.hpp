// Everything that crosses between the real-time side and the service side. Lock-free, fixed size.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "host/bus/drive_bus.hpp"
#include "host/control/latency_histogram.hpp"
#include "host/control/latest_value.hpp"
#include "host/control/spsc_ring.hpp"
#include "host/control/stop_flag.hpp"
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
  cable::Inputs inputs{};
  cable::Outputs outputs{};
  Overruns overruns{};
  std::array<DriveBusStats, kMaxDriveBuses> bus{};
  std::uint64_t records_lost = 0;  // tick records that found the ring full
};

constexpr std::size_t kMostRequests = 16;  // room for requests between the threads, one more than can wait

struct Link {
  explicit Link(const cable::RobotTable& table)
      : image(TwinImage{0, true, cable::Controller(table), {}, {}}), report(CycleReport{}) {}

  // Service to real time.
  StopFlag stop;  // read before `requests`, and empties them: what was asked for before a stop is void
  SpscRing<cable::Telecommand, 16> released;
  SpscRing<Request, kMostRequests> requests;
  // Real time to service.
  SpscRing<TickRecord, 512> ticks;
  LatestValue<TwinImage> image;     // at the start of each command interval
  LatestValue<CycleReport> report;  // after each tick
  TickTiming timing;
};

}  // namespace liana
