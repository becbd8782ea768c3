// Everything that crosses between the real-time side and the service side. Lock-free, fixed size.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "host/control/realtime/drive_channel.hpp"
#include "host/control/realtime/latest_value.hpp"
#include "host/control/realtime/spsc_ring.hpp"
#include "host/control/realtime/stop_flag.hpp"
#include "host/control/realtime/tick_times.hpp"
#include "host/control/verification/twin_snapshot.hpp"
#include "host/drives/bus/drive_bus.hpp"
#include "host/storage/recording/tick_record.hpp"

namespace liana::realtime {

// What the real-time side reports after every tick, of any robot.
struct TickStatus {
  std::uint64_t next_tick = 0;  // ticks done so far
  BootPhase boot = BootPhase::kBooting;
  Overruns overruns{};
  std::array<bus::DriveBusStats, bus::kMaxDriveBuses> bus{};
  std::uint64_t records_lost = 0;  // tick records that found the ring full
};

// The same with what the arm itself adds.
template <class Arm>
struct ArmTickStatus : TickStatus {
  Inputs<Arm> inputs{};
  Outputs<Arm> outputs{};
};

constexpr std::size_t kMaxRequests = 16;  // room for requests between the threads, one more than can wait

// What the adapter was asked for last; sequence 0: nothing yet. Aligned as a whole: else clang calls a library for its
// atomic.
struct alignas(2) AdapterOrder {
  serial::AdapterCommand command = serial::AdapterCommand::kNone;
  std::uint8_t sequence = 0;
};
static_assert(std::atomic<AdapterOrder>::is_always_lock_free);

// What crosses whatever the arm is.
struct Link {
  // Service to real time.
  StopFlag stop;  // read before `requests`, and empties them: what was asked for before a stop is void
  SpscRing<Request, kMaxRequests> requests;
  std::atomic<AdapterOrder> adapter{AdapterOrder{}};  // serial arms only
  // Real time to service.
  TickTiming timing;
};

// All that crosses for one kind of arm.
template <class Arm>
struct ArmMailbox : Link {
  explicit ArmMailbox(const typename Arm::Table& table)
      : image(verification::TwinSnapshot<Arm>(table)), report(ArmTickStatus<Arm>{}) {}

  // Service to real time.
  SpscRing<Telecommand<typename Arm::Setpoint>, 16> released;
  // Real time to service.
  SpscRing<recording::TickRecord<Arm>, 512> ticks;
  LatestValue<verification::TwinSnapshot<Arm>> image;  // at the start of each command interval
  LatestValue<ArmTickStatus<Arm>> report;              // after each tick
};

}  // namespace liana::realtime
