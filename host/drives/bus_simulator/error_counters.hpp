// The fault confinement of one CAN controller (ISO 11898-1): error counters, and the state that follows from them.
#pragma once

#include <cstdint>
#include <optional>

#include "host/drives/bus/can_frame.hpp"

namespace liana::bus_simulator {

// In rising order of trouble.
enum class ErrorState : std::uint8_t { kActive, kWarning, kPassive, kBusOff };

// Each event returns the error frame by which a Linux driver reports a change of state (linux/can/error.h), or nothing.
class ErrorCounters {
 public:
  std::optional<bus::CanFrame> transmitted() noexcept;
  std::optional<bus::CanFrame> received() noexcept;
  // An own frame was destroyed.
  std::optional<bus::CanFrame> transmit_failed() noexcept;
  // Nobody acknowledged an own frame; a passive controller no longer counts this, so that it alone never leads to
  // bus-off.
  std::optional<bus::CanFrame> unacknowledged() noexcept;
  // Somebody else's frame was destroyed.
  std::optional<bus::CanFrame> receive_failed() noexcept;
  // Back from bus-off.
  std::optional<bus::CanFrame> restart() noexcept;

  ErrorState state() const noexcept { return state_; }

 private:
  std::optional<bus::CanFrame> judge() noexcept;
  bus::CanFrame report(std::uint32_t error_class, std::uint8_t controller) const noexcept;

  int transmit_ = 0;
  int receive_ = 0;
  ErrorState state_ = ErrorState::kActive;
};

}  // namespace liana::bus_simulator
