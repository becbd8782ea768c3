#include "host/control/server/push_message.hpp"

#include <array>
#include <utility>

namespace liana::server {

namespace {

constexpr std::array kPhases{"none", "taring", "relieving", "pressing", "unloading", "yielding"};
constexpr std::array kEnds{"none",  "captured",      "sensor_lost",    "overload", "travel",
                           "aside", "early_capture", "adapter_silent", "stopped"};
constexpr std::array kHealth{"good", "silent", "saturated", "failed", "no_number", "not_at_rest", "stuck"};
constexpr std::array kCatches{"open", "closing", "closed", "failed"};
static_assert(kPhases.size() == static_cast<std::size_t>(serial::InsertPhase::kYielding) + 1);
static_assert(kEnds.size() == static_cast<std::size_t>(serial::InsertResult::kStopped) + 1);
static_assert(kHealth.size() == static_cast<std::size_t>(serial::WristHealth::kStuck) + 1);
static_assert(kCatches.size() == static_cast<std::size_t>(serial::CatchState::kFailed) + 1);

template <class Names, class Value>
const char* name_of(const Names& names, Value value) {
  return names.at(static_cast<std::size_t>(value));
}

Json wrench_json(const serial::Wrench& wrench) {
  return {{"force_N", wrench.force_N}, {"torque_Nm", wrench.torque_Nm}};
}

// Seconds; null: never heard.
Json age_json(std::uint16_t age_ticks, double tick_s) {
  return age_ticks == serial::kNeverHeard ? Json() : Json(age_ticks * tick_s);
}

}  // namespace

Json push_json(const serial::InsertStatus& push, double tick_s) {
  const bool was_asked = push.number > 0;
  const auto of_push = [&](Json value) { return was_asked ? std::move(value) : Json(); };
  const bool is_heard = push.wrist_age_ticks != serial::kNeverHeard;
  return {{"number", push.number},
          {"phase", name_of(kPhases, push.phase)},
          {"end", name_of(kEnds, push.end)},
          {"law", push.law == serial::InsertLaw::kImpedance ? "impedance" : "force"},
          {"force_setpoint_N", of_push(push.set_N)},
          {"applied_force", of_push(wrench_json(push.given))},
          {"measured_wrench", is_heard ? wrench_json(push.felt) : Json()},
          {"touched", push.touched != 0},
          {"travel_m", of_push(push.travel_m)},
          {"lateral_m", of_push(push.aside_m)},
          {"wrist", name_of(kHealth, push.wrist)},
          {"wrist_age_s", age_json(push.wrist_age_ticks, tick_s)}};
}

Json adapter_json(const serial::InsertStatus& push, double tick_s) {
  Json depth_m;
  if (push.adapter_age_ticks != serial::kNeverHeard) {
    depth_m = Json::array();
    for (const std::uint8_t depth : push.depth_01mm) depth_m.push_back(1e-4 * depth);
  }
  return {{"age_s", age_json(push.adapter_age_ticks, tick_s)},
          {"sequence", push.adapter_sequence},
          {"captured", push.captured != 0},
          {"latch", name_of(kCatches, push.latch)},
          {"lock", name_of(kCatches, push.lock)},
          {"depth_m", depth_m}};
}

}  // namespace liana::server
