#include "hil/arm/tip_tool.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace liana::bench {

void TipTool::ask(ToolCommand command) {
  if (defects_.silent) return;
  command_ = std::move(command);
  acting_ = false;
}

ToolStatus TipTool::say(std::string phase, std::string reason, double now_s) {
  last_ = {command_->number, std::move(phase), std::move(reason), now_s};
  if (last_.phase != "acting") command_.reset();
  return last_;
}

std::optional<std::string> TipTool::why_it_fails(const Vec3& tip_m, const Vec3& rod_m) const {
  if (command_->command != "repair") return "the tool knows repair only, not " + command_->command;
  if (has_rod_) return "the rod is out already";
  const double apart_m = norm(rod_m - tip_m);
  if (apart_m > kReach_m)
    return "the rod is " + std::to_string(static_cast<int>(1e3 * apart_m + 0.5)) + " mm from the tip, at most " +
           std::to_string(static_cast<int>(1e3 * kReach_m)) + " mm can be gripped";
  return std::nullopt;
}

std::optional<ToolStatus> TipTool::act(double now_s, const Vec3& tip_m, const Vec3& rod_m) {
  if (!command_ || now_s < command_->begin_s) return std::nullopt;
  if (const auto why = why_it_fails(tip_m, rod_m)) return say("failed", *why, now_s);
  if (!acting_) {
    acting_ = true;
    return say("acting", "", now_s);
  }
  const double acted_s = now_s - command_->begin_s;
  if (defects_.jams && acted_s > 0.5 * kActing_s) return say("failed", "the tool is jammed", now_s);
  if (acted_s < kActing_s) return std::nullopt;
  has_rod_ = true;
  return say("done", "", now_s);
}

std::optional<ToolCommand> tool_command(const std::string& message) {
  const nlohmann::json json = nlohmann::json::parse(message, nullptr, false);
  const auto is = [&](const char* name, auto type) { return json.contains(name) && (json[name].*type)(); };
  using Value = nlohmann::json;
  if (!json.is_object() || !is("op", &Value::is_string) || json["op"] != "tool") return std::nullopt;
  if (!is("number", &Value::is_number_integer) || !is("command", &Value::is_string) ||
      !is("begin_s", &Value::is_number))
    return std::nullopt;
  return ToolCommand{json["number"], json["command"], json["begin_s"]};
}

std::string tool_message(const ToolStatus& report) {
  nlohmann::json message{
      {"op", "tool_report"}, {"number", report.number}, {"phase", report.phase}, {"time_s", report.time_s}};
  if (!report.reason.empty()) message["reason"] = report.reason;
  return message.dump();
}

}  // namespace liana::bench
