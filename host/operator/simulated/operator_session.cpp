#include "host/operator/simulated/operator_session.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "host/operator/simulated/camera_message.hpp"

namespace liana::simulated {
namespace {

constexpr double kSamplePeriod_s = 0.001;
constexpr double kHandlesPeriod_s = 1.0 / 90.0;
constexpr double kLongestGap_s = 0.1;     // after a pause the hand goes on, it does not catch up
constexpr double kSettleAfterVr_s = 1.0;  // the person watches the arm come to rest before saying so
constexpr const char* kDefaultRecording = "panel_edge_vr";

std::string text(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

// A positive number, or `otherwise`.
double positive(const Json& object, const char* key, double otherwise) {
  const auto found = object.find(key);
  const double value = found != nullptr && found->is_number() ? found->get<double>() : otherwise;
  return value > 0.0 ? value : otherwise;
}

long milliseconds(double from_s, double to_s) { return std::lround((to_s - from_s) / kSamplePeriod_s); }

}  // namespace

device::Kind other_of(device::Kind kind) {
  return kind == device::Kind::kVrControllers ? device::Kind::kHandController : device::Kind::kVrControllers;
}

HandTask hand_task(const AnnouncedStep& step) {
  if (step.task == "rod") return HandTask::kReachRod;
  if (step.task == "slit") return HandTask::kEnterSlit;
  return step.name.find("rod") != std::string::npos ? HandTask::kReachRod : HandTask::kEnterSlit;
}

AnnouncedStep announced_step(const Json& state) {
  const auto found = state.find("step");
  if (found == nullptr || !found->is_object()) return {};
  return {found->value("index", std::int64_t{-1}), text(*found, "name"), text(*found, "device"), text(*found, "task"),
          found->value("entry", std::int64_t{0})};
}

HandMapping announced_mapping(const Json& state) {
  const auto found = state.find("mapping");
  if (found == nullptr || !found->is_object()) return {};
  return {positive(*found, "scale", 1.0), positive(*found, "rotation_scale", 1.0), positive(*found, "speed_m_s", 0.0)};
}

OperatorSession::OperatorSession(std::vector<std::string> recordings, const SlitModel& drawing, const HandGains& gains,
                                 std::uint64_t seed, Temper temper)
    : recordings_(std::move(recordings)), person_(gains, drawing, seed, temper), seed_(seed), temper_(temper) {}

// The first there is; where there is none the last, for the message.
std::string OperatorSession::recording_called(const std::string& name) const {
  std::string file;
  for (const std::string& folder : recordings_) {
    file = folder + "/" + name + ".hand";
    if (std::filesystem::exists(file)) break;
  }
  return file;
}

void OperatorSession::begin_step(const AnnouncedStep& step, const Json& state) {
  reported_ = false;
  finished_s_ = -1.0;
  if (step.device == "vr") {
    const std::string name = step.task.empty() ? kDefaultRecording : step.task;
    vr_.emplace(read_vr_recording(recording_called(name)), VrDisturbance{}, seed_, temper_);
  } else {
    person_.begin(hand_task(step), announced_mapping(state), now_s_);
  }
}

OperatorAnswer OperatorSession::on_state(const Json& state) {
  const double to_s = state.at("time_s").get<double>();
  const double from_s = now_s_ < 0.0 ? to_s : std::max(now_s_, to_s - kLongestGap_s);
  now_s_ = to_s;
  const AnnouncedStep step = announced_step(state);
  if (step.index != step_.index || step.entry != step_.entry || step.device != step_.device) steering_ = false;
  step_ = step;
  const bool ours = (step.device == "vr" || step.device == "hand") && text(state, "device") == step.device;
  if (ours && !steering_) begin_step(step, state);
  steering_ = steering_ || ours;
  if (!steering_) return {};
  const bool engaged = state.value("device_engaged", false);
  return step.device == "vr" ? steer_vr(from_s, to_s, engaged) : steer_hand(from_s, to_s, engaged);
}

OperatorAnswer OperatorSession::steer_vr(double from_s, double to_s, bool engaged) {
  vr_->feel(engaged, to_s);
  OperatorAnswer answer{.kind = device::Kind::kVrControllers};
  for (const BothHands& hands : vr_->advance(from_s, to_s - from_s))
    answer.samples.insert(answer.samples.end(), {hands.right, hands.left});
  for (long i = 1; i <= milliseconds(from_s, to_s); ++i) {
    if (const auto held = person_.idle(from_s + static_cast<double>(i) * kSamplePeriod_s))
      answer.aside.push_back(*held);
  }
  if (vr_->finished() && finished_s_ < 0.0) finished_s_ = to_s;
  report_arrival(answer.messages, finished_s_ >= 0.0 && to_s - finished_s_ > kSettleAfterVr_s, to_s);
  return answer;
}

OperatorAnswer OperatorSession::steer_hand(double from_s, double to_s, bool engaged) {
  person_.feel(engaged, to_s);
  OperatorAnswer answer{.kind = device::Kind::kHandController};
  for (long i = 1; i <= milliseconds(from_s, to_s); ++i)
    answer.samples.push_back(person_.sample(from_s + static_cast<double>(i) * kSamplePeriod_s));
  if (vr_) hold_handles_too(answer.aside, from_s, to_s);
  report_arrival(answer.messages, person_.arrived(), to_s);
  return answer;
}

void OperatorSession::hold_handles_too(std::vector<device::Sample>& aside, double from_s, double to_s) {
  const auto count = std::lround((to_s - from_s) / kHandlesPeriod_s);
  for (long i = 1; i <= count; ++i) {
    const double t_s = from_s + (to_s - from_s) * static_cast<double>(i) / static_cast<double>(count);
    if (const auto held = vr_->idle(t_s)) aside.insert(aside.end(), {held->right, held->left});
  }
}

void OperatorSession::report_arrival(std::vector<Json>& messages, bool arrived, double now_s) {
  if (!arrived || reported_) return;
  reported_ = true;
  messages.push_back({{"op", "operator_says"}, {"what", "arrived"}, {"step", step_.index}, {"time_s", now_s}});
}

void OperatorSession::on_camera(const Json& message) { person_.look(sighting_of(message), std::max(now_s_, 0.0)); }

}  // namespace liana::simulated
