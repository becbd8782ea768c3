// What became of each command of a run, from its file of stages (docs/reference/formats.md).
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "host/base/event/dispatch.hpp"

namespace liana::report {

// A command, or a request of which none came (command 0).
struct CommandRecord {
  std::uint64_t command = 0;
  std::uint64_t tick = 0;  // when it was asked for
  std::string owner;       // or client
  std::int64_t kind = 0;   // CommandKind; of a request RefusalEvent
  std::optional<event::Dispatch> execution, simulation, release, start, complete, refusal;

  bool is_command() const { return command != 0; }
  bool is_refused() const { return refusal.has_value(); }
};

// In the order in which they were asked for. `unread`: lines that are no stages.
std::vector<CommandRecord> command_lives(std::istream& lines, std::size_t& unread);

}  // namespace liana::report
