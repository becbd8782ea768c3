// The force/torque sensor at the wrist: what its strain gauges make of a load, and node 0x20 on the bus
// (docs/explanation/payload.md).
#pragma once

#include <array>
#include <cstdint>

#include "hil/drive/self_starting_node.hpp"
#include "hil/math/random.hpp"
#include "hil/serial/tip_state.hpp"

namespace liana::bench {

// All assumed, as those of sensors of this size; forces in N, torques in N m.
struct WristParams {
  double force_noise_N = 0.2;  // standard deviation of a reading
  double torque_noise_Nm = 0.05;
  double force_bias_N = 0.5;  // most, of each axis, constant over a run
  double torque_bias_Nm = 0.1;
  double force_step_N = 0.02;  // of what is sent
  double torque_step_Nm = 0.01;
  double force_full_N = 500.0;  // saturates beyond
  double torque_full_Nm = 250.0;
};

enum class WristStatus : std::uint8_t { kGood = 0, kSaturated = 1, kFailed = 2 };

struct WristReading {
  std::array<std::int16_t, 3> force{};   // in steps
  std::array<std::int16_t, 3> torque{};  // in steps
  WristStatus status = WristStatus::kGood;
};

// What may be wrong with it.
struct WristDefects {
  bool failed = false;     // says so, and reads nothing
  bool stuck = false;      // reads what it did, and says that all is well
  bool saturated = false;  // an amplifier is at its end: full scale along z
  bool silent = false;     // says nothing, and has no heartbeat
};

class WristSensor {
 public:
  static constexpr std::uint32_t kNode = 0x20;

  // Noise is drawn from the seed, as it belongs to any sensor; with `spread` a bias, too.
  WristSensor(std::uint8_t bus, bool spread, std::uint64_t seed, const WristParams& figures = {});

  void suffer(const WristDefects& defects) { defects_ = defects; }
  // Hears the slot's frames and sends what is due; `load` is the mean since the last SYNC (its anti-aliasing filter).
  void exchange(const FrameList& frames, std::uint64_t now_us, const TipLoad& load, FrameList& out);
  // One reading of a load.
  WristReading read(const TipLoad& load);

  const TipLoad& bias() const { return bias_; }

 private:
  void report(const WristReading& reading, FrameList& out);

  WristParams figures_;
  Random noise_;
  TipLoad bias_;
  SelfStartingNode node_;
  WristDefects defects_;
  WristReading last_;
  std::uint8_t sequence_ = 0;
};

}  // namespace liana::bench
