#include "host/drives/bus_simulator/error_counters.hpp"

#include <linux/can.h>
#include <linux/can/error.h>

#include <algorithm>

namespace liana::bus_simulator {
namespace {

constexpr int kFailedTransmission = 8;
constexpr int kWarning = 96, kPassive = 128, kBusOff = 256;
constexpr int kMaxReceiveErrors = 255, kAfterPassiveReceiver = 127;

ErrorState state_for(int transmit, int receive) noexcept {
  if (transmit >= kBusOff) return ErrorState::kBusOff;
  const int worst = std::max(transmit, receive);
  if (worst >= kPassive) return ErrorState::kPassive;
  return worst >= kWarning ? ErrorState::kWarning : ErrorState::kActive;
}

}  // namespace

std::optional<bus::CanFrame> ErrorCounters::transmitted() noexcept {
  transmit_ = std::max(0, transmit_ - 1);
  return judge();
}

std::optional<bus::CanFrame> ErrorCounters::received() noexcept {
  receive_ = receive_ > kAfterPassiveReceiver ? kAfterPassiveReceiver : std::max(0, receive_ - 1);
  return judge();
}

std::optional<bus::CanFrame> ErrorCounters::transmit_failed() noexcept {
  transmit_ += kFailedTransmission;
  return judge();
}

std::optional<bus::CanFrame> ErrorCounters::unacknowledged() noexcept {
  return state_ == ErrorState::kPassive ? std::nullopt : transmit_failed();
}

std::optional<bus::CanFrame> ErrorCounters::receive_failed() noexcept {
  receive_ = std::min(kMaxReceiveErrors, receive_ + 1);
  return judge();
}

std::optional<bus::CanFrame> ErrorCounters::restart() noexcept {
  if (state_ != ErrorState::kBusOff) return std::nullopt;
  *this = ErrorCounters{};
  return report(CAN_ERR_RESTARTED, 0);
}

std::optional<bus::CanFrame> ErrorCounters::judge() noexcept {
  const ErrorState next = state_for(transmit_, receive_);
  if (next == state_ || state_ == ErrorState::kBusOff) return std::nullopt;
  state_ = next;
  const bool transmitting = transmit_ >= receive_;
  switch (next) {
    case ErrorState::kBusOff:
      return report(CAN_ERR_BUSOFF, 0);
    case ErrorState::kPassive:
      return report(CAN_ERR_CRTL, transmitting ? CAN_ERR_CRTL_TX_PASSIVE : CAN_ERR_CRTL_RX_PASSIVE);
    case ErrorState::kWarning:
      return report(CAN_ERR_CRTL, transmitting ? CAN_ERR_CRTL_TX_WARNING : CAN_ERR_CRTL_RX_WARNING);
    case ErrorState::kActive:
      return report(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE);
  }
  return std::nullopt;
}

bus::CanFrame ErrorCounters::report(std::uint32_t error_class, std::uint8_t controller) const noexcept {
  bus::CanFrame frame;
  frame.id = CAN_ERR_FLAG | error_class;
  frame.length = CAN_ERR_DLC;
  frame.data[1] = controller;
  frame.data[6] = static_cast<std::uint8_t>(std::min(transmit_, 255));
  frame.data[7] = static_cast<std::uint8_t>(receive_);
  return frame;
}

}  // namespace liana::bus_simulator
