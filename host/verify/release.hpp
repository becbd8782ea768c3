// The one place where telecommands are made: a candidate becomes a telecommand only with both verdicts.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_like/telecommand.hpp"
#include "host/verify/verdict.hpp"

namespace liana {

// A command on its way through verification. Only the twin can look inside.
class Candidate {
 public:
  std::uint64_t sequence() const { return telecommand_.sequence(); }
  std::uint64_t first_tick() const { return telecommand_.first_tick(); }
  std::uint64_t expiry_tick() const { return telecommand_.expiry_tick(); }
  const Setpoint& setpoint() const { return telecommand_.setpoint(); }

 private:
  friend class Release;
  friend class Twin;
  explicit Candidate(const Telecommand& telecommand) : telecommand_(telecommand) {}
  Telecommand telecommand_;
};

class Release {
 public:
  // A candidate with a sequence of its own for the interval [first_tick, first_tick + interval_ticks).
  Candidate candidate(const Setpoint& setpoint, std::uint32_t owner, std::uint64_t first_tick,
                      std::uint64_t interval_ticks);
  // The telecommand; nothing unless both ends passed exactly this candidate, the newest one, and it was not released
  // before.
  std::optional<Telecommand> release(const Candidate& candidate, const ExecutionVerdict& execution,
                                     const SimulationVerdict& simulation);

 private:
  std::uint64_t last_sequence_ = 0;
  std::uint64_t last_released_ = 0;
};

}  // namespace liana
