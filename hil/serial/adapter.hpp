// The adapter that a payload is pushed into: three pins in three funnels, a capture spring, a stop, depth sensors, a
// latch that closes when they say "captured", and a drive that locks what is latched (docs/explanation/payload.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hil/serial/capture_logic.hpp"
#include "hil/serial/pin_contact.hpp"
#include "hil/serial/tip_state.hpp"

namespace liana::bench {

// Of a latch or lock drive, with the values that go over the wire.
enum class Closure : std::uint8_t { kOpen = 0, kClosing = 1, kClosed = 2, kFailed = 3 };

// Everything is in the socket's frame: z into it, the origin in the middle of its face. The plate that carries the pins
// has its origin in the middle of their tips and its z along them.
class Adapter {
 public:
  explicit Adapter(const AdapterParams& figures = {}) : figures_(figures) {}

  // What the socket does to the plate, about the plate's origin. Depends on nothing but the plate and the latch.
  TipLoad push(const TipState& plate) const;
  // Sensors, latch and lock drive, once per physics step, with the plate as it is after the step.
  void step(double step_s, const TipState& plate);

  // How far each pin is behind the face [m], as its sensor reads it; below 0 before it.
  const PinValues& depth_m() const { return depth_m_; }
  bool captured() const { return logic_.captured(); }
  bool latched() const { return latched_at_m_.has_value(); }
  Closure latch() const { return latch_; }
  Closure lock() const { return lock_; }
  // The lock drive begins, or goes on where it had failed; nothing without a closed latch.
  void begin_lock();
  // Opens latch and lock for good, and forgets the capture.
  void release();

  // Faults from outside.
  PinDefects& defects(std::size_t pin) { return defects_.at(pin); }
  void break_latch(bool broken = true) { latch_works_ = !broken; }  // it stays open
  void break_lock(bool broken = true) { lock_works_ = !broken; }    // its drive stops half-way

  const AdapterParams& figures() const { return figures_; }

 private:
  Vec3 place_on_circle(std::size_t pin) const;
  PinState pin_of(std::size_t pin, const TipState& plate) const;
  void move_latch(double step_s, const PinValues& true_m);
  void move_lock(double step_s);

  AdapterParams figures_;
  std::array<PinDefects, kPins> defects_;
  bool latch_works_ = true;
  bool lock_works_ = true;
  CaptureLogic logic_;
  PinValues depth_m_{-1.0, -1.0, -1.0};
  std::optional<PinValues> latched_at_m_;  // depths of the pins when it closed
  Closure latch_ = Closure::kOpen;
  Closure lock_ = Closure::kOpen;
  double latching_s_ = 0.0;  // since the capture
  double locking_s_ = 0.0;   // since it was asked for
  double drawn_in_m_ = 0.0;  // by the lock drive
};

}  // namespace liana::bench
