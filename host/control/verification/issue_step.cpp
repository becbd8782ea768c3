#include "host/control/verification/issue_step.hpp"

#include "firmware_like/command/release.hpp"

namespace liana::verification {

template <class Arm>
Candidate<Arm> IssueStep<Arm>::candidate(const typename Arm::Setpoint& setpoint, std::uint32_t owner,
                                         std::uint64_t first_tick, std::uint64_t interval_ticks) {
  last_trial_ = 0;
  return Candidate<Arm>(Release::make(++last_sequence_, first_tick, first_tick + interval_ticks, owner, setpoint), 0);
}

template <class Arm>
Candidate<Arm> IssueStep<Arm>::another(const typename Arm::Setpoint& setpoint, const Candidate<Arm>& refused) {
  const auto& before = refused.telecommand_;
  return Candidate<Arm>(
      Release::make(before.sequence(), before.first_tick(), before.expiry_tick(), before.owner(), setpoint),
      ++last_trial_);
}

template <class Arm>
std::optional<Telecommand<typename Arm::Setpoint>> IssueStep<Arm>::release(const Candidate<Arm>& candidate,
                                                                           const ExecutionVerdict& execution,
                                                                           const SimulationVerdict& simulation) {
  const std::uint64_t sequence = candidate.sequence();
  const auto passed = [&candidate](const Verdict& verdict) {
    return verdict.passed() && verdict.sequence == candidate.sequence() && verdict.trial == candidate.trial();
  };
  const bool is_newest = sequence == last_sequence_ && candidate.trial() == last_trial_;
  if (!passed(execution) || !passed(simulation) || !is_newest || sequence == last_released_) return std::nullopt;
  last_released_ = sequence;
  return candidate.telecommand_;
}

template class IssueStep<cable::CableArm>;
template class IssueStep<serial::SerialArm>;

}  // namespace liana::verification
