// What an archive holds, row by row. Times are ticks of the life; Life::period_s makes seconds of them.
#pragma once

#include <cstdint>
#include <string>

#include "host/base/json/json.hpp"

namespace liana::archive {

// A stretch of ticks, both ends included.
struct Span {
  std::uint64_t first = 0, last = 0;
};
constexpr Span kAll{0, INT64_MAX};

// One life of lianad.
struct Life {
  std::string config_hash, robot, scene, buses;  // the last three: JSON, as the welcome has them
  std::string time_mode;                         // fast, paced or real
  double period_s = 0.0;
  std::string started_utc;  // ISO 8601, when the archive began
  std::string made_by;      // version and build
};

// A command that verification has judged. What it said stands only beside those that it refused.
struct Command {
  std::uint64_t sequence = 0;
  std::uint64_t tick = 0;  // of the state that told of it
  bool released = false;
  int code = 0;        // M_e, 0: released
  double share = 0.0;  // of the limit that the motion comes nearest to
  std::string name{}, text{}, remedy{}, margin{};
};

// Something that is not in the archive, and why. `count`: of events or states, of which telemetry lacks one each.
struct Gap {
  std::uint64_t first_tick = 0, last_tick = 0;
  std::string what;  // events, states or telemetry
  std::uint64_t count = 0;
  std::string text;
};

// What a state says besides its numbers, from a tick until the next facts.
struct Facts {
  std::uint64_t tick = 0;
  std::uint32_t number = 0;  // as records name them
  Json state;
};

}  // namespace liana::archive
