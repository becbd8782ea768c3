#include "host/apps/report/stages.hpp"

#include <tuple>

#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

std::optional<Pose> pose_of(const Json& numbers) {
  if (!numbers.is_array() || numbers.size() != 7) return std::nullopt;
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = numbers[i].get<double>();
  for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = numbers[i + 3].get<double>();
  return pose;
}

bool is_same(const Stage& a, const Stage& b) {
  const auto told = [](const Stage& s) {
    return std::tie(s.servo, s.target, s.push, s.push_end, s.set_N, s.says_captured);
  };
  return told(a) == told(b);
}

// Spans of what `is_on` says; `end` is what the stage behind them tells.
template <class IsOn, class End>
std::vector<Span> spans_of(const std::vector<Stage>& stages, const IsOn& is_on, const End& end) {
  std::vector<Span> spans;
  bool was_on = false;
  for (const Stage& stage : stages) {
    if (is_on(stage) && !was_on) spans.push_back({stage.tick, stage.tick, "none", stage.target, stage.place});
    if (was_on || is_on(stage)) spans.back().end_tick = stage.tick;
    if (was_on && !is_on(stage)) spans.back().end = end(stage);
    was_on = is_on(stage);
  }
  return spans;
}

}  // namespace

void keep_stage(std::vector<Stage>& stages, const Json& state) {
  Stage stage;
  stage.tick = state.value("tick", std::uint64_t{0});
  const Json &servo = state.member_or_null("servo"), &push = state.member_or_null("insert"),
             &adapter = state.member_or_null("adapter");
  if (servo.is_object()) {
    stage.servo = servo.value("phase", stage.servo);
    stage.target = servo.value("target", "");
    stage.place = pose_of(servo.member_or_null("place"));
  }
  if (push.is_object()) {
    stage.push = push.value("phase", stage.push);
    stage.push_end = push.value("end", stage.push_end);
    const Json& set_N = push.member_or_null("force_setpoint_N");  // null: no push yet
    stage.set_N = set_N.is_number() ? set_N.get<double>() : 0.0;
  }
  if (adapter.is_object()) stage.says_captured = adapter.value("captured", false);
  if (stages.empty() || !is_same(stages.back(), stage)) stages.push_back(stage);
}

std::vector<Span> servos_of(const std::vector<Stage>& stages) {
  return spans_of(
      stages, [](const Stage& s) { return s.servo_is_under_way(); }, [](const Stage& s) { return s.servo; });
}

std::vector<Span> pushes_of(const std::vector<Stage>& stages) {
  return spans_of(
      stages, [](const Stage& s) { return s.push_is_under_way(); }, [](const Stage& s) { return s.push_end; });
}

}  // namespace liana::report
