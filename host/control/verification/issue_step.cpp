#include "host/control/verification/issue_step.hpp"

#include "firmware_like/command/release.hpp"

namespace liana::verification {

template <class Arm>
Candidate<Arm> IssueStep<Arm>::candidate(const typename Arm::Setpoint& setpoint, std::uint32_t owner,
                                         std::uint64_t first_tick, std::uint64_t interval_ticks) {
  return Candidate<Arm>(Release::make(++last_sequence_, first_tick, first_tick + interval_ticks, owner, setpoint));
}

template <class Arm>
std::optional<Telecommand<typename Arm::Setpoint>> IssueStep<Arm>::release(const Candidate<Arm>& candidate,
                                                                           const ExecutionVerdict& execution,
                                                                           const SimulationVerdict& simulation) {
  const std::uint64_t sequence = candidate.sequence();
  const bool both =
      execution.sequence == sequence && execution.passed() && simulation.sequence == sequence && simulation.passed();
  if (!both || sequence != last_sequence_ || sequence == last_released_) return std::nullopt;
  last_released_ = sequence;
  return candidate.telecommand_;
}

template class IssueStep<cable::CableArm>;
template class IssueStep<serial::SerialArm>;

}  // namespace liana::verification
