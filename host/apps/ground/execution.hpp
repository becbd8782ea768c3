// Telecommands that lianad has taken, and how their execution ends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/api/ground/dictionary.hpp"
#include "host/base/json/json.hpp"

namespace liana::ground {

// Under this name the on-board end is a client of lianad.
inline constexpr const char* kClientName = "ground";

// How a step of a telecommand ended. Code 0: with success.
struct Ending {
  std::uint16_t code = 0;
  std::uint32_t detail = 0;
  std::string text{};
};

struct Execution {
  Telecommand telecommand{};
  const CommandRow* row = nullptr;
  Json request{};
  std::uint64_t id = 0;               // of the request
  bool is_answered = false;           // by lianad, with ok
  double deadline_s = 0.0;            // when it counts as not completed
  std::uint64_t refused_motions = 0;  // of the state before the request
  unsigned states = 0;                // that have come since the answer
};

Ending failed(Failure failure, std::uint32_t detail = 0);
// What lianad's answer `error` makes of it.
Ending refused(const Json& answer);
// How an answered execution has ended by this state; nothing while it goes on.
std::optional<Ending> judge(const Execution& execution, const Json& state);
// Whether the request ends motions that were begun before.
bool replaces_motion(const Execution& execution);
// Whether it waits for the arm to come to its goal.
bool is_motion(const Execution& execution);

}  // namespace liana::ground
