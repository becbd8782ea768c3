// The tool at the tip, as lianad knows it: one command at a time, and what the tool says of it.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "host/api/server/arguments.hpp"
#include "host/base/event/event.hpp"
#include "host/base/json/json.hpp"

namespace liana::server {

class TipTool {
 public:
  // The tool begins so long after it was asked [s]: by then the command has certainly reached it, so that runs in
  // virtual time repeat.
  static constexpr double kNotice_s = 0.2;

  // Takes a command for a connected tool; what the tool is told (topic `tool` of docs/reference/api.md). Throws
  // api::RequestError: no_device without a tool, busy while one is under way.
  Json ask(const std::string& command, double time_s, bool is_connected);
  // What the tool says, to count from `due_tick` on. Throws api::RequestError for another command than the last.
  void hear(const api::Arguments& report, std::uint64_t due_tick);
  // What counts by now; an event when the command has ended.
  std::optional<event::Event> pass(std::uint64_t tick);
  // The tool's connection is lost: a command under way has failed.
  std::optional<event::Event> lose();
  // For the state message. Not whether a tool is connected: when it comes is no matter of virtual time, and states of
  // equal runs are equal.
  Json json() const;

 private:
  struct Word {
    std::uint64_t due_tick;
    std::string phase;
    std::string reason;
  };

  bool is_under_way() const { return phase_ == "asked" || phase_ == "acting"; }
  std::optional<event::Event> turn(Word word);

  std::int64_t number_ = 0;  // commands so far
  std::string command_, phase_ = "none", reason_;
  std::deque<Word> heard_;
};

}  // namespace liana::server
