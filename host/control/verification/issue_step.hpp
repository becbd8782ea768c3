// The step after both verdicts: a candidate becomes a telecommand only here.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/control/verification/verdict.hpp"

namespace liana::verification {

template <class Arm>
class Twin;
template <class Arm>
class IssueStep;

// A command on its way through verification. Only the twin can look inside.
template <class Arm>
class Candidate {
 public:
  using Command = Telecommand<typename Arm::Setpoint>;

  std::uint64_t sequence() const { return telecommand_.sequence(); }
  // 0 for what was asked for; counts what was tried in its place.
  std::uint32_t trial() const { return trial_; }
  std::uint64_t first_tick() const { return telecommand_.first_tick(); }
  std::uint64_t expiry_tick() const { return telecommand_.expiry_tick(); }
  const typename Arm::Setpoint& setpoint() const { return telecommand_.setpoint(); }

 private:
  friend class IssueStep<Arm>;
  friend class Twin<Arm>;
  Candidate(const Command& telecommand, std::uint32_t trial) : telecommand_(telecommand), trial_(trial) {}
  Command telecommand_;
  std::uint32_t trial_;
};

template <class Arm>
class IssueStep {
 public:
  // A candidate with a sequence of its own for the interval [first_tick, first_tick + interval_ticks).
  Candidate<Arm> candidate(const typename Arm::Setpoint& setpoint, std::uint32_t owner, std::uint64_t first_tick,
                           std::uint64_t interval_ticks);
  // One in the place of `refused`, the newest candidate: for its interval and owner, under its sequence.
  Candidate<Arm> another(const typename Arm::Setpoint& setpoint, const Candidate<Arm>& refused);
  // The telecommand; nothing unless both ends passed exactly this candidate, the newest one, and it was not released
  // before.
  std::optional<Telecommand<typename Arm::Setpoint>> release(const Candidate<Arm>& candidate,
                                                             const ExecutionVerdict& execution,
                                                             const SimulationVerdict& simulation);

 private:
  std::uint64_t last_sequence_ = 0;
  std::uint32_t last_trial_ = 0;
  std::uint64_t last_released_ = 0;
};

extern template class IssueStep<cable::CableArm>;
extern template class IssueStep<serial::SerialArm>;

}  // namespace liana::verification
