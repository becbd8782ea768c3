// What happened and why, for people and for tools that know no Liana: DIR/state.mcap with the JSON channels `state`
// and `event` (as the API publishes them) and `verdict` (each once), every one with a JSON Schema.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/base/json/json.hpp"
#include "host/storage/recording/mcap.hpp"

namespace liana::recording {

constexpr const char* kStateFile = "state.mcap";

class StateRecording {
 public:
  // Creates the file (DIR must exist); throws std::runtime_error. `period_s` is that of the ticks.
  StateRecording(const std::string& directory, double period_s);
  // Takes one `state` message: `text` as it came, `state` parsed.
  void take(std::string_view text, const Json& state);
  // Takes one `event` or `events_lost` message: `text` as it came, `event` parsed.
  void take_event(std::string_view text, const Json& event);
  // Events that lianad no longer had for this recording.
  std::uint64_t events_lost() const { return events_lost_; }
  // Ends the file, with how many events it has and how many were lost; throws std::runtime_error when the disk refused
  // any write.
  void finish();

 private:
  void write(std::uint16_t channel, std::uint64_t tick, std::string_view text);
  void take_verdict(std::uint64_t tick, const Json& verdict);

  McapWriter file_;
  double period_s_;
  std::uint16_t state_, event_, verdict_;
  std::uint64_t events_ = 0, events_lost_ = 0;
  std::string verdict_seen_;
};

}  // namespace liana::recording
