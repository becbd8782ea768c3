// A push along an axis of the tip by force control, and giving way: what both ask of the joints in every tick
// (docs/explanation/force-control.md). Forces are what the arm gives; the sensor says what it gets.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware_like/serial/adapter_monitor.hpp"
#include "firmware_like/serial/force_law.hpp"
#include "firmware_like/serial/setpoint.hpp"
#include "firmware_like/serial/wrist.hpp"

namespace liana::serial {

constexpr std::uint32_t kTareTicks = 25;  // what the sensor says over so long is taken for nothing
constexpr double kMaxTare_N = 15.0;       // more is no bias: something pushes already
constexpr double kMaxTare_Nm = 10.0;
constexpr std::uint32_t kRelievedTicks = 25;       // the five other axes are free of load for so long ...
constexpr std::uint32_t kMaxRelievingTicks = 500;  // ... or have had their time, before anything is pushed
constexpr double kRelieved_N = 2.0;
constexpr double kRelieved_Nm = 1.0;
constexpr double kContactShare = 0.1;       // of the set force, along the axis: the payload has met the adapter ...
constexpr std::uint16_t kTouchTicks = 150;  // ... when felt so long in a row; what speeding up takes fades sooner
constexpr double kApproachShare = 0.3;      // of the set force, where nothing resists: a wall is met gently
constexpr double kResistShare = 0.2;        // of the set force, felt along the axis: something resists ...
constexpr std::uint16_t kResistTicks = 75;  // ... when felt so long, until less than kContactShare is felt
constexpr std::uint16_t kOverloadTicks = 3;
constexpr double kForwardFilter_s = 0.3;         // of F_e in the feed-forward
constexpr double kFollowFrom_Nm = 20.0;          // a joint gives way above this torque (requirement B29)
constexpr double kFollow_Nm_per_rad_s = 2000.0;  // by one rad/s for so much more

enum class InsertPhase : std::uint8_t {
  kNone = 0,       // no push, and nobody gives way
  kTaring = 1,     // stands still
  kRelieving = 2,  // no set force: the five other axes lose what they carry first (requirement B30)
  kPressing = 3,
  kUnloading = 4,  // captured: no set force any more
  kYielding = 5,   // ended, or asked to follow: joints give way above kFollowFrom_Nm and hold their places else
};

// Why a push is not pressing any more; the numbers never change meaning.
enum class InsertResult : std::uint8_t {
  kNot = 0,
  kCaptured = 1,
  kSensorLost = 2,     // with the fault wrist_sensor_lost
  kOverload = 3,       // with the fault push_overload
  kTravel = 4,         // the way along the axis is spent
  kAside = 5,          // off the axis, or turned, farther than allowed
  kEarlyCapture = 6,   // the adapter said "captured" before any force of contact was felt
  kAdapterSilent = 7,  // it spoke when the push began
  kStopped = 8,        // a hold, a stop, an end of commands, or a fault of anything else
};

struct InsertState {
  Push order{};
  InsertPhase phase = InsertPhase::kNone;
  InsertResult end = InsertResult::kNot;
  std::uint32_t phase_ticks = 0;
  std::uint32_t relieved_ticks = 0;
  Pose start{};      // of the tip, measured, when it began
  Twist velocity{};  // v_d of the tip, base frame
  Wrench tare_sum{};
  Wrench forward{};                // F_e as the torque feed-forward has it, base frame
  double approach_m = 0.0;         // impedance: of the point that it pulls to, from the start
  std::uint16_t touch_ticks = 0;   // force of contact was felt, in a row; from kTouchTicks on it stays there
  std::uint16_t resist_ticks = 0;  // in which something resisted
  std::uint8_t adapter_spoke = 0;  // when it began
  std::uint16_t overload_ticks = 0;
  WristHealth lost = WristHealth::kGood;  // kSensorLost: what is wrong with it
  std::int16_t overload_joint = -1;       // kOverload: which; -1: the force at the tip
  double overload = 0.0;                  // N or N.m
  // Of this tick, for the report.
  Wrench given{};         // by the arm, tip frame, above the tare
  double set_N = 0.0;     // along the axis
  double travel_m = 0.0;  // along the axis, from the start
  double aside_m = 0.0;
};
static_assert(std::is_trivially_copyable_v<InsertState>);

// What the joints should do in a tick.
struct ForceMotion {
  JointVector rate_rad_s{};
  JointVector torque_Nm{};   // feed-forward
  bool holds_place = false;  // besides, each is drawn to its target
};

struct InsertInputs {
  const JointVector& measured_rad;
  const JointVector& torque_Nm;   // of the joint sensors: what the gears give to the links
  const JointVector& rate_rad_s;  // told in the last tick
  const AdapterState& adapter;
  bool allowed;  // false: it ends
};

// The payload has met the adapter.
inline bool has_touched(const InsertState& state) noexcept { return state.touch_ticks >= kTouchTicks; }

// Takes a usable setpoint of kind kPush or kFollow into force; one with the number of the push under way goes on with
// it.
void accept_force(const Setpoint& setpoint, InsertState& state) noexcept;

// One tick. The sensor's tare is taken here, too.
ForceMotion advance_force(const RobotParams& table, const InsertInputs& in, WristState& wrist,
                          InsertState& state) noexcept;

}  // namespace liana::serial
