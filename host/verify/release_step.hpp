// The step after both verdicts: a candidate becomes a telecommand only here.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_like/cable_controller.hpp"
#include "host/verify/verdict.hpp"

namespace liana {

// A command on its way through verification. Only the twin can look inside.
class Candidate {
 public:
  std::uint64_t sequence() const { return telecommand_.sequence(); }
  std::uint64_t first_tick() const { return telecommand_.first_tick(); }
  std::uint64_t expiry_tick() const { return telecommand_.expiry_tick(); }
  const cable::Setpoint& setpoint() const { return telecommand_.setpoint(); }

 private:
  friend class ReleaseStep;
  friend class Twin;
  explicit Candidate(const cable::Telecommand& telecommand) : telecommand_(telecommand) {}
  cable::Telecommand telecommand_;
};

class ReleaseStep {
 public:
  // A candidate with a sequence of its own for the interval [first_tick, first_tick + interval_ticks).
  Candidate candidate(const cable::Setpoint& setpoint, std::uint32_t owner, std::uint64_t first_tick,
                      std::uint64_t interval_ticks);
  // The telecommand; nothing unless both ends passed exactly this candidate, the newest one, and it was not released
  // before.
  std::optional<cable::Telecommand> release(const Candidate& candidate, const ExecutionVerdict& execution,
                                            const SimulationVerdict& simulation);

 private:
  std::uint64_t last_sequence_ = 0;
  std::uint64_t last_released_ = 0;
};

}  // namespace liana
