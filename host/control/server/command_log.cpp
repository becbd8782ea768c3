#include "host/control/server/command_log.hpp"

#include "host/control/verification/refusal_table.hpp"

namespace liana::server {

using event::Stage;

CommandLog::CommandLog(const std::string& path) : file_(path, "--commands", event::kDispatchHeading) {}

void CommandLog::note_active(std::uint64_t tick, std::uint64_t sequence) {
  if (sequence == active_) return;
  if (active_ != 0) write({.stage = Stage::kComplete, .tick = tick, .command = active_});
  active_ = sequence;
  if (active_ != 0) write({.stage = Stage::kStart, .tick = tick, .command = active_});
}

void CommandLog::write_verdict(Stage stage, std::uint64_t tick, const verification::Verdict& verdict,
                               bool has_margins) {
  event::Dispatch d{.stage = stage,
                    .tick = tick,
                    .command = verdict.sequence,
                    .number = event::number_of(verdict.code),
                    .share = verdict.share,
                    .text = verdict.passed() ? verdict.margin : verdict.text};
  const verification::Margins& m = verdict.margins;
  if (has_margins) d.margins = {m.clearance_m, m.joint_deg, m.rate_deg_s, m.tension_N, m.time_us};
  write(d);
}

void CommandLog::note(std::uint64_t tick, const std::string& owner, const LastVerdict& verdict) {
  const std::uint64_t command = verdict.sequence;
  write({.stage = Stage::kSetpoint,
         .tick = tick,
         .command = command,
         .number = event::number_of(verdict.kind),
         .subject = owner});
  write_verdict(Stage::kExecution, tick, verdict.execution, false);
  write_verdict(Stage::kSimulation, tick, verdict.simulation, true);
  if (verdict.released) {
    const auto first_tick = static_cast<std::int64_t>(verdict.first_tick);
    return write({.stage = Stage::kRelease, .tick = tick, .command = command, .number = first_tick});
  }
  write({.stage = Stage::kRefusal,
         .tick = tick,
         .command = command,
         .number = event::number_of(verdict.worst.code),
         .subject = verification::refusal_action_name(verdict.stops ? verification::RefusalAction::kStop
                                                                    : verification::RefusalAction::kHold),
         .text = verdict.worst.text});
}

void CommandLog::note_request(std::uint64_t tick, const event::Event& refusal) {
  write({.stage = Stage::kRequest,
         .tick = tick,
         .number = refusal.number,
         .subject = refusal.subject,
         .text = refusal.text});
}

}  // namespace liana::server
