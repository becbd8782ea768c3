// Which values of the core's enumerations have a meaning.
#pragma once

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/command/request.hpp"
#include "firmware_like/command/telecommand.hpp"
#include "firmware_like/math/ik_outcome.hpp"
#include "firmware_like/safety/faults.hpp"
#include "firmware_like/safety/supervisor.hpp"
#include "firmware_like/serial_controller.hpp"

namespace liana::recording {

// True from the first to the last of an enumeration without gaps that starts at 0.
template <class E>
constexpr bool is_up_to(E value, E last) {
  return value >= E{} && value <= last;
}

constexpr bool is_known(CommandKind kind) { return is_up_to(kind, CommandKind::kFollow); }
constexpr bool is_known(StopCategory category) { return is_up_to(category, StopCategory::kOff); }
constexpr bool is_known(cable::SegmentReleaseStage stage) {
  return is_up_to(stage, cable::SegmentReleaseStage::kUndone);
}
constexpr bool is_known(cable::ContactState state) { return is_up_to(state, cable::ContactState::kDithered); }
constexpr bool is_known(Phase phase) { return is_up_to(phase, Phase::kResetting); }
constexpr bool is_known(IkOutcome outcome) { return is_up_to(outcome, IkOutcome::kUnreachable); }
constexpr bool is_known(Request request) { return is_up_to(request, Request::kRecover); }
constexpr bool is_known(OperatingState state) { return is_up_to(state, OperatingState::kFault); }
constexpr bool is_known(serial::WristStatus status) { return is_up_to(status, serial::WristStatus::kFailed); }
constexpr bool is_known(serial::CatchState state) { return is_up_to(state, serial::CatchState::kFailed); }
constexpr bool is_known(serial::WristHealth health) { return is_up_to(health, serial::WristHealth::kStuck); }
constexpr bool is_known(serial::InsertLaw law) { return is_up_to(law, serial::InsertLaw::kImpedance); }
constexpr bool is_known(serial::InsertPhase phase) { return is_up_to(phase, serial::InsertPhase::kYielding); }
constexpr bool is_known(serial::InsertResult end) { return is_up_to(end, serial::InsertResult::kStopped); }
inline bool is_known(FaultNumber number) { return fault_info(number).number == number; }

}  // namespace liana::recording
