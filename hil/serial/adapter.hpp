// The adapter that a payload is pushed into: three pins in three funnels, a capture spring, a stop, depth sensors and a
// latch that closes when they say "captured" (docs/payload.md).
#pragma once

#include <array>
#include <optional>

#include "hil/serial/capture_logic.hpp"
#include "hil/serial/pin_contact.hpp"
#include "hil/serial/tip_state.hpp"

namespace liana::bench {

// Everything is in the socket's frame: z into it, the origin in the middle of its face. The plate that carries the pins
// has its origin in the middle of their tips and its z along them.
class Adapter {
 public:
  explicit Adapter(const AdapterFigures& figures = {}) : figures_(figures) {}

  // What the socket does to the plate, about the plate's origin. Depends on nothing but the plate and the latch.
  TipLoad push(const TipState& plate) const;
  // Sensors and latch, once per physics step, with the plate as it is after the step.
  void step(double step_s, const TipState& plate);

  // How far each pin is behind the face [m], as its sensor reads it; below 0 before it.
  const PinValues& depth_m() const { return depth_m_; }
  bool captured() const { return logic_.captured(); }
  bool latched() const { return latched_at_m_.has_value(); }
  // Opens the latch for good, and forgets the capture.
  void release();

  // Faults from outside.
  PinDefects& defects(std::size_t pin) { return defects_.at(pin); }
  void break_latch() { latch_works_ = false; }  // it stays open

  const AdapterFigures& figures() const { return figures_; }

 private:
  Vec3 place_on_circle(std::size_t pin) const;
  PinState pin_of(std::size_t pin, const TipState& plate) const;

  AdapterFigures figures_;
  std::array<PinDefects, kPins> defects_;
  bool latch_works_ = true;
  CaptureLogic logic_;
  PinValues depth_m_{-1.0, -1.0, -1.0};
  std::optional<PinValues> latched_at_m_;  // depths of the pins when it closed
};

}  // namespace liana::bench
