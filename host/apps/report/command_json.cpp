#include "host/apps/report/command_json.hpp"

#include <cmath>

#include "firmware_like/command/telecommand.hpp"
#include "host/base/json/json.hpp"
#include "host/control/verification/refusal_table.hpp"

namespace liana::report {
namespace {

using event::Dispatch;

Json margins_json(const Dispatch& verdict) {
  Json out = Json::object();
  for (std::size_t i = 0; verdict.margins && i < event::kMargins; ++i) {
    const double margin = (*verdict.margins)[i];
    out[event::kMarginNames[i]] = std::isfinite(margin) ? Json(margin) : Json();
  }
  return out;
}

Json verdict_json(const std::optional<Dispatch>& verdict) {
  if (!verdict) return nullptr;
  return {{"code", verdict->number},
          {"share", verdict->share},
          {"margins", margins_json(*verdict)},
          {"text", verdict->text}};
}

Json refusal_json(const CommandRecord& life) {
  if (!life.refusal) return nullptr;
  if (!life.is_command()) return {{"text", life.refusal->text}};
  const verification::RefusalRow& row = verification::row_of(static_cast<verification::Refusal>(life.refusal->number));
  return {{"code", life.refusal->number},
          {"name", row.name},
          {"action", life.refusal->subject},
          {"text", life.refusal->text},
          {"remedy", row.remedy}};
}

Json tick_json(const std::optional<Dispatch>& stage) { return stage ? Json(stage->tick) : Json(); }

}  // namespace

const char* command_kind_name(const CommandRecord& life) {
  if (!life.is_command()) return "request";
  switch (static_cast<CommandKind>(life.kind)) {
    case CommandKind::kTip:
      return "tip";
    case CommandKind::kJoint:
      return "joints";
    case CommandKind::kRetract:
      return "retract";
    case CommandKind::kPush:
      return "insert";
    case CommandKind::kFollow:
      return "comply";
    default:
      return "other";
  }
}

Json command_json(const CommandRecord& life) {
  return {{"command", life.command},
          {"tick", life.tick},
          {"owner", life.owner},
          {"kind", command_kind_name(life)},
          {"execution", verdict_json(life.execution)},
          {"simulation", verdict_json(life.simulation)},
          {"in_force_from", life.release ? Json(life.release->number) : Json()},
          {"started", tick_json(life.start)},
          {"completed", tick_json(life.complete)},
          {"refusal", refusal_json(life)}};
}

}  // namespace liana::report
