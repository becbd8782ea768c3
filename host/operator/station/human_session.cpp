#include "host/operator/station/human_session.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "host/operator/simulated/camera_message.hpp"
#include "host/operator/simulated/delayed_gains.hpp"

namespace liana::station {
namespace {

constexpr double kMillisecond_s = 0.001;
constexpr double kLongestGap_s = 0.1;  // after a pause the hands go on, they do not catch up
constexpr double kUnsure_m =
    0.015;  // the measured tip beside the commanded one, in free motion (docs/explanation/operator-model.md)
constexpr double kFirm_N_m = 500.0;  // a grip for fine work
// In the slit, slower than the person whose hand nothing moves, and slow earlier: what tremor and felt forces add, and
// guidance that begins at the mouth, swings the tip faster than the table allows (0.0331 m/s at 0.0252, 0.0318 at
// 0.0235).
constexpr double kSlowBeforeMouth_m = 0.09;
constexpr double kSlitSpeed_m_s = 0.0205;

simulated::HandGains hand_gains(const HumanTable& table) {
  simulated::HandGains gains = under_delay(simulated::HandGains{}, table.there_and_back_s);
  gains.tremor_m = 0.0;  // the muscles' own, in the hand on the device
  gains.slow_before_mouth_m = kSlowBeforeMouth_m;
  gains.slit_speed_m_s = std::min(gains.slit_speed_m_s, kSlitSpeed_m_s);
  return gains;
}

// The person's reaction time is their own, not the muscles'.
haptics::HandParams hand_on_device() {
  haptics::HandParams hand;
  hand.stiffness_N_m = kFirm_N_m;
  hand.reaction_s = 0.0;
  return hand;
}

haptics::HandLoopTable loop_of(const HumanTable& table) {
  haptics::HandLoopTable loop;
  loop.gains.unsure_m = kUnsure_m;
  if (table.passivity) return loop;
  loop.tank.start_J = loop.tank.most_J = std::numeric_limits<double>::infinity();
  loop.damping_N_s_m = 0.0;
  return loop;
}

simulated::SlitModel drawing_of(const config::SceneConfig& scene) {
  if (!scene.slit || !scene.rod) return {};
  const auto pose = [](const config::ScenePose& p) { return Pose{p.position_m, p.quaternion_wxyz}; };
  return simulated::slit_drawing(pose(scene.slit->frame), pose(scene.rod->pose));
}

Pose pose_in(const Json& state, const char* key) {
  const Json list = state.value(key, Json());
  if (!list.is_array() || list.size() != 7)
    throw std::runtime_error(std::string("state message: ") + key +
                             ": allowed [x,y,z,qw,qx,qy,qz]; see docs/reference/api.md");
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = list[i].get<double>();
  for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = list[i + 3].get<double>();
  return pose;
}

Vec3 place(const double (&p)[3]) { return {p[0], p[1], p[2]}; }

std::int64_t microseconds(double time_s) { return std::llround(time_s * 1e6); }

}  // namespace

std::optional<simulated::TipObservation> sighting_in(const Json& picture) {
  try {
    return simulated::sighting_of(picture);
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "liana-operator: %s\n", error.what());
    return std::nullopt;
  }
}

HumanSession::HumanSession(const HumanTable& table, const config::RobotConfig& robot, const config::SceneConfig& scene)
    : table_(table),
      node_(static_cast<std::size_t>(robot.table.segment_count + 1) / 2),
      display_(robot.table, robot.module_radius_m),
      vr_person_(under_delay(simulated::VrGains{}, table.there_and_back_s), scene, table.seed, table.temper),
      hand_person_(hand_gains(table), drawing_of(scene), table.seed, table.temper),
      held_(loop_of(table), hand_on_device(), table.seed),
      prediction_(robot.table, arbiter::SpeedZone(scene.slit, robot.table.limits.tip_speed_slit_m_s)) {}

void HumanSession::begin_step(const Json& state, double now_s) {
  const simulated::HandMapping mapping = simulated::announced_mapping(state);
  steering_ = true;
  reported_ = false;
  acted_s_ = handles_s_ = now_s;
  if (step_.device == "vr") return vr_person_.begin(mapping, now_s);
  hand_person_.begin(simulated::hand_task(step_), mapping, now_s);
  held_.loop().scale_by(mapping.scale);
  choose_law(state);
  prediction_.begin(
      {"hand", device::Kind::kHandController, {mapping.scale, mapping.rotation_scale}, 0, mapping.speed_m_s, false},
      pose_in(state, "setpoint_cp"));
}

void HumanSession::choose_law(const Json& state) {
  const Json& told = state.member_or_null("mapping").member_or_null("feedback");
  const std::string of_step = told.is_string() ? told.get<std::string>() : "aligned";
  const auto law = haptics::law_of(table_.feedback.empty() ? of_step : table_.feedback);
  feels_arm_ = law.has_value();
  if (law) held_.loop().choose(*law);
}

void HumanSession::hear(const News& news, double now_s) {
  const Json& state = news.state;
  const simulated::AnnouncedStep step = simulated::announced_step(state);
  if (step.index != step_.index || step.entry != step_.entry || step.device != step_.device) steering_ = false;
  step_ = step;
  const bool ours = (step.device == "vr" || step.device == "hand") && state.value("device", "") == step.device;
  if (ours && !steering_) begin_step(state, now_s);
  if (!steering_) return;
  const bool engaged = state.value("device_engaged", false);
  if (step_.device == "hand") return hear_of_hand(news, engaged, now_s);
  vr_person_.feel(engaged, now_s);
  vr_person_.look(display_.picture(state.at("measured_js_deg").get<std::vector<double>>(), node_), now_s);
}

// Where the measured tip and the commanded one differ at rest is no contact: the prediction counts from there.
void HumanSession::hear_of_hand(const News& news, bool engaged, double now_s) {
  hand_person_.feel(engaged, now_s);
  for (const Json& picture : news.pictures) {
    if (const auto seen = sighting_in(picture)) hand_person_.look(*seen, now_s);
  }
  if (!engaged && !prediction_.engaged()) {
    const Pose commanded = pose_in(news.state, "setpoint_cp");
    prediction_.stand_at(commanded);
    beside_m_ = subtract(pose_in(news.state, "measured_cp").position_m, commanded.position_m);
    slowed_m_ = {};
  }
  if (news.for_device) feel(*news.for_device);
  feel_walls(news.for_device ? &*news.for_device : nullptr);
}

void HumanSession::feel(const liana_state& told) {
  const haptics::Motion tip{place(told.measured_cp.position_m), place(told.measured_cv.linear_m_s)};
  const bool answers = told.answers_us >= 0 && (told.flags & LIANA_ENGAGED) != 0;
  const std::int64_t of_us = told.answers_us + told.held_us;
  if (const auto then = predicted_.at(of_us); answers && then)
    errors_m_.push_back(norm(subtract(tip.position_m, then->position_m)));
  if (const auto then = unmended_.at(of_us); answers && then)
    slowed_m_ = subtract(place(told.setpoint_cp.position_m), then->position_m);
  if (feels_arm_) held_.loop().take({told.header.sequence, told.answers_us, told.held_us, tip});
}

// A wall that is not told any more has no stiffness.
void HumanSession::feel_walls(const liana_state* told) {
  static_assert(haptics::kMaxWalls == LIANA_MAX_PLANES);
  const std::uint32_t count = table_.walls && told != nullptr ? told->planes : 0;
  for (std::size_t slot = 0; slot < haptics::kMaxWalls; ++slot) {
    const liana_plane none{{1.0, 0.0, 0.0}, 0.0, 0.0, 0.0};
    const liana_plane& plane = slot < count ? told->plane[slot] : none;
    held_.loop().take({place(plane.normal), plane.offset_m, plane.stiffness_N_m, plane.damping_N_s_m}, slot);
  }
}

simulated::OperatorAnswer HumanSession::act(double now_s) {
  simulated::OperatorAnswer answer;
  if (!steering_) return answer;
  const double from_s = std::max(acted_s_, now_s - kLongestGap_s);
  acted_s_ = now_s;
  const bool handles = step_.device == "vr";
  answer.kind = handles ? device::Kind::kVrControllers : device::Kind::kHandController;
  answer.samples = handles ? lead(now_s) : steer(from_s, now_s);
  hold_other_too(answer.aside, from_s, now_s);
  if (!has_arrived() || reported_) return answer;
  reported_ = true;
  answer.messages.push_back({{"op", "operator_says"}, {"what", "arrived"}, {"step", step_.index}, {"time_s", now_s}});
  return answer;
}

// A lively person has the other device in hand as well, at times.
void HumanSession::hold_other_too(std::vector<device::Sample>& aside, double from_s, double now_s) {
  const double period_s = step_.device == "vr" ? kMillisecond_s : simulated::VrOperatorModel::kSample_s;
  const auto count = std::lround((now_s - from_s) / period_s);
  for (long i = 1; i <= count; ++i) {
    const double t_s = from_s + (now_s - from_s) * static_cast<double>(i) / static_cast<double>(count);
    if (step_.device == "vr") {
      if (const auto held = hand_person_.idle(t_s)) aside.push_back(*held);
    } else if (const auto held = vr_person_.idle(t_s)) {
      aside.insert(aside.end(), {held->right, held->left});
    }
  }
}

bool HumanSession::has_arrived() const { return step_.device == "vr" ? vr_person_.arrived() : hand_person_.arrived(); }

std::vector<device::Sample> HumanSession::lead(double now_s) {
  std::vector<device::Sample> samples;
  for (; handles_s_ + simulated::VrOperatorModel::kSample_s <= now_s;
       handles_s_ += simulated::VrOperatorModel::kSample_s) {
    const simulated::BothHands hands = vr_person_.sample(handles_s_ + simulated::VrOperatorModel::kSample_s);
    samples.push_back(hands.right);
    samples.push_back(hands.left);
  }
  return samples;
}

// The arm does what the filter says, unless a limit of its joints slows it down: how far, the newest state tells.
void HumanSession::predict(double now_s) {
  const haptics::Motion tip = prediction_.motion();
  const haptics::Motion mended{add(add(tip.position_m, slowed_m_), beside_m_), tip.velocity_m_s};
  unmended_.put(microseconds(now_s), tip);
  predicted_.put(microseconds(now_s), mended);
  held_.loop().predict(microseconds(now_s), mended);
  prediction_.finish_interval();
}

std::vector<device::Sample> HumanSession::steer(double from_s, double now_s) {
  std::vector<device::Sample> samples;
  const auto count = std::lround((now_s - from_s) / kMillisecond_s);
  for (long i = 1; i <= count; ++i) {
    const device::Sample wish = hand_person_.sample(from_s + static_cast<double>(i) * kMillisecond_s);
    samples.push_back(held_.step(wish, add(prediction_.goal().position_m, beside_m_)));
    prediction_.add(samples.back());
  }
  predict(now_s);
  return samples;
}

HandMotionParams HumanSession::figures() const { return {held_.peak_force_N(), held_.min_energy_J(), errors_m_}; }

}  // namespace liana::station
