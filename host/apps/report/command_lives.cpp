#include "host/apps/report/command_lives.hpp"

#include <istream>

namespace liana::report {
namespace {

using event::Dispatch;

std::optional<Dispatch>* place_of(event::Stage stage, CommandRecord& life) {
  switch (stage) {
    case event::Stage::kExecution:
      return &life.execution;
    case event::Stage::kSimulation:
      return &life.simulation;
    case event::Stage::kRelease:
      return &life.release;
    case event::Stage::kStart:
      return &life.start;
    case event::Stage::kComplete:
      return &life.complete;
    case event::Stage::kRefusal:
    case event::Stage::kRequest:
      return &life.refusal;
    case event::Stage::kSetpoint:
      break;
  }
  return nullptr;
}

// Stages of a command come soon after it: it is among the newest.
CommandRecord* find(std::vector<CommandRecord>& lives, std::uint64_t command) {
  for (auto life = lives.rbegin(); life != lives.rend(); ++life) {
    if (life->command == command) return &*life;
  }
  return nullptr;
}

void take(const Dispatch& d, std::vector<CommandRecord>& lives) {
  const bool begins = d.stage == event::Stage::kSetpoint || d.stage == event::Stage::kRequest;
  if (begins) lives.push_back({d.command, d.tick, d.subject, d.number, {}, {}, {}, {}, {}, {}});
  CommandRecord* life = begins ? &lives.back() : find(lives, d.command);
  if (life == nullptr) return;
  if (std::optional<Dispatch>* place = place_of(d.stage, *life)) *place = d;
}

}  // namespace

std::vector<CommandRecord> command_lives(std::istream& lines, std::size_t& unread) {
  std::vector<CommandRecord> lives;
  unread = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    if (const auto stage = event::dispatch_from_line(line)) {
      take(*stage, lives);
    } else {
      ++unread;
    }
  }
  return lives;
}

}  // namespace liana::report
