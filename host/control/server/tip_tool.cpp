#include "host/control/server/tip_tool.hpp"

#include <utility>

#include "host/api/server/request_error.hpp"
#include "host/control/server/emergency_stop.hpp"

namespace liana::server {

Json TipTool::ask(const std::string& command, double time_s, bool is_connected) {
  if (!is_connected)
    throw api::RequestError("no_device", "no tool is connected: start the one that says hello with role tool");
  if (is_under_way())
    throw api::RequestError("busy", "the tool is still at '" + command_ + "': wait until tool.phase is done or failed");
  ++number_;
  command_ = command, phase_ = "asked", reason_.clear();
  heard_.clear();
  return {{"op", "tool"}, {"number", number_}, {"command", command_}, {"begin_s", time_s + kNotice_s}};
}

void TipTool::hear(const api::Arguments& report, std::uint64_t due_tick) {
  if (report.integer("number") != number_ || !is_under_way()) {
    throw api::RequestError("refused", "number = " + std::to_string(report.integer("number")) +
                                           ": no such command is under way; report on the last one only");
  }
  heard_.push_back({due_tick, report.text("phase"), report.has("reason") ? report.text("reason") : ""});
}

std::optional<event::Event> TipTool::turn(Word word) {
  phase_ = std::move(word.phase), reason_ = printable(word.reason);
  if (is_under_way()) return std::nullopt;
  heard_.clear();
  const std::string why = reason_.empty() ? "" : ": " + reason_;
  return event::Event{
      .kind = event::EventKind::kTool, .subject = "tool", .text = "tool: " + command_ + " " + phase_ + why};
}

std::optional<event::Event> TipTool::pass(std::uint64_t tick) {
  std::optional<event::Event> ended;
  while (!heard_.empty() && heard_.front().due_tick <= tick) {
    Word word = std::move(heard_.front());
    heard_.pop_front();
    ended = turn(std::move(word));
  }
  return ended;
}

std::optional<event::Event> TipTool::lose() {
  if (!is_under_way()) return std::nullopt;
  return turn({0, "failed", "the tool is gone"});
}

Json TipTool::json() const {
  return {{"number", number_}, {"command", command_}, {"phase", phase_}, {"reason", reason_}};
}

}  // namespace liana::server
