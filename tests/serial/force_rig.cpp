#include "tests/serial/force_rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware_like/drive/ideal_drive.hpp"
#include "firmware_like/math/convert.hpp"
#include "tests/serial/both_tables.hpp"

namespace liana::test {
namespace {

using bench::Vec3;

constexpr Vec3 kPlateInTip_m{0.0, 0.0, 1.0};  // the payload is a metre long
constexpr double kClear_m = 0.002;            // of a funnel's wall, where a misaligned push begins
constexpr int kStepsInTick = 16;              // of 0.25 ms at 250 Hz
constexpr int kStepsInLoop = 4;               // the drives' loops run at 1 kHz

bench::BodyConfig payload_of(double mass_kg) {
  bench::BodyConfig body;
  body.mass_kg = mass_kg;
  body.center_m = {0.0, 0.0, 0.5};
  body.inertia_kgm2 = {mass_kg / 6.0, mass_kg / 6.0, mass_kg / 6.0, 0.0, 0.0, 0.0};
  return body;
}

bench::SerialRobotConfig model_of(const ForceCase& settings) {
  bench::SerialRobotConfig model = bench_robot(config::good_table("robot", "macro_micro"));
  for (double& stiffness : model.stiffness_Nm_rad) stiffness *= settings.gear_share;
  model.coulomb_Nm = settings.coulomb_Nm;
  auto base = std::make_shared<bench::LockedBaseConfig>(*model.base);
  for (double& stiffness : base->robot.stiffness_Nm_rad) stiffness *= settings.base_share;
  model.base = base;
  return model;
}

config::SerialRobotConfig host_robot() {
  config::SerialRobotConfig robot =
      config::parse_serial_robot(config::good_table("robot", "macro_micro").dump(), "macro_micro");
  robot.table.tick_s = 0.004;
  robot.table.interval_ticks = 5;
  return robot;
}

bench::Pose beyond(const bench::Pose& pose, const Vec3& by_m) {
  return {pose.position_m + bench::rotate(pose.attitude, by_m), pose.attitude};
}

liana::Vec3 quantised(const Vec3& v, double step) {
  return {step * std::round(v.x / step), step * std::round(v.y / step), step * std::round(v.z / step)};
}

}  // namespace

ForceCase drawn_case(std::uint64_t seed) {
  Numbers numbers(seed);
  ForceCase out;
  out.seed = seed;
  out.aside_m = {numbers.in(-0.0014, 0.0014), numbers.in(-0.0014, 0.0014), 0.0};
  const double tilt = numbers.in(0.0, 0.5) * 3.14159265358979 / 180.0, towards = numbers.in(0.0, 6.28);
  out.tilt_rad = {tilt * std::cos(towards), tilt * std::sin(towards), 0.0};
  out.adapter.friction = numbers.in(0.05, 0.3);
  out.noise_N = numbers.in(0.05, 1.0);  // over what is sent in steps of 0.02 N: less is a stuck sensor
  out.payload_kg = numbers.in(300.0, 1000.0);
  out.base_share = numbers.in(0.8, 1.2);
  out.gear_share = numbers.in(0.7, 1.3);
  out.coulomb_Nm = numbers.in(4.0, 15.0);
  out.adapter.spring_N_m *= numbers.in(0.8, 1.15);
  out.adapter.stiffness_N_m = std::pow(10.0, numbers.in(4.0, 5.3));
  out.bias_N = {numbers.in(-0.5, 0.5), numbers.in(-0.5, 0.5), numbers.in(-0.5, 0.5)};
  return out;
}

ForceCase misaligned_case(std::uint64_t seed, const Misalignment& most) {
  ForceCase out = drawn_case(seed);
  Numbers numbers(~seed);
  const double aside = most.aside_m * std::sqrt(numbers.in(0.0, 1.0)), towards = numbers.in(0.0, 6.28);
  const double tilt = numbers.in(0.0, most.tilt_rad), about = numbers.in(0.0, 6.28);
  out.aside_m = {aside * std::cos(towards), aside * std::sin(towards), 0.0};
  out.tilt_rad = {tilt * std::cos(about), tilt * std::sin(about), 0.0};
  const double lowest_pin = out.adapter.circle_m * std::sin(tilt);
  out.before_m = std::max(0.001, kClear_m + lowest_pin + aside - out.adapter.entry_m);
  out.most_aside_m = 0.03;
  return out;
}

ForceRig::ForceRig(const ForceCase& settings, const std::string& pose)
    : case_(settings),
      robot_(host_robot()),
      model_(model_of(settings)),
      chain_(std::make_unique<bench::FlexibleChain>(model_, model_.named_poses_rad.at(pose),
                                                    payload_of(settings.payload_kg))),
      adapter_(settings.adapter),
      controller_(robot_.table),
      noise_state_(settings.seed * 2 + 1) {
  if (settings.never_captures)
    for (std::size_t pin = 0; pin < bench::kPins; ++pin) adapter_.defects(pin).reads_m = 0.015;
  const bench::Pose plate = beyond(chain_->tip().pose, kPlateInTip_m);
  const bench::Quat turned = plate.attitude * bench::from_rotation_vector(settings.tilt_rad);
  socket_in_root_ = {
      plate.position_m + bench::rotate(turned, Vec3{settings.aside_m.x, settings.aside_m.y, settings.before_m}),
      turned};
  base_start_m_ = chain_->base().pose.position_m;
  for (std::size_t i = 0; i < 7; ++i) {
    inputs_.drive[i].statusword = 0x0250;
    inputs_.drive[i].operational = 1;
  }
}

// Even in [-1, 1) with the spread of a normal one's standard deviation 1 / sqrt 3.
double ForceRig::noise() {
  noise_state_ = noise_state_ * 6364136223846793005ULL + 1442695040888963407ULL;
  return static_cast<double>(noise_state_ >> 11) / 4503599627370496.0 - 1.0;
}

bench::TipState ForceRig::plate() const {
  const bench::TipState tip = chain_->tip();
  const Vec3 arm = bench::rotate(tip.pose.attitude, kPlateInTip_m);
  const bench::Quat into = bench::conjugate(socket_in_root_.attitude);
  const Vec3 velocity = tip.velocity_m_s + bench::cross(tip.rate_rad_s, arm);
  return {bench::relative(socket_in_root_, beyond(tip.pose, kPlateInTip_m)),
          bench::rotate(into, velocity) - Vec3{0.0, 0.0, socket_m_s_}, bench::rotate(into, tip.rate_rad_s)};
}

bench::TipLoad ForceRig::load_on_tip(const bench::TipState& tip) const {
  const Vec3 arm = bench::rotate(tip.pose.attitude, kPlateInTip_m);
  const bench::Quat into = bench::conjugate(socket_in_root_.attitude);
  const bench::TipState plate{
      bench::relative(socket_in_root_, beyond(tip.pose, kPlateInTip_m)),
      bench::rotate(into, tip.velocity_m_s + bench::cross(tip.rate_rad_s, arm)) - Vec3{0.0, 0.0, socket_m_s_},
      bench::rotate(into, tip.rate_rad_s)};
  contact_ = adapter_.push(plate);
  const Vec3 force = bench::rotate(socket_in_root_.attitude, contact_.force_N);
  const Vec3 torque = bench::rotate(socket_in_root_.attitude, contact_.torque_Nm) + bench::cross(arm, force);
  return {force + outside_.force_N, torque + outside_.torque_Nm};
}

void ForceRig::read_drives() {
  for (std::size_t i = 0; i < 7; ++i) {
    const serial::DriveParams& drive = robot_.table.drive[i];
    DriveFeedback& feedback = inputs_.drive[i];
    feedback = ideal_feedback(feedback, out_.drive[i], 0);
    feedback.feedback_age_ticks = 0;
    feedback.position_counts = to_counts(serial::counts_at_joint(drive, chain_->rotor_rad(i))).value;
    const double permille = drive.direction * chain_->gear_Nm(i) / drive.torque_per_permille_Nm;
    feedback.torque_permille = narrow<std::int16_t>(to_counts(permille).value);
  }
}

void ForceRig::read_sensors() {
  const bench::TipLoad felt = chain_->wrist();
  const auto noisy = [&](const Vec3& v, double size) {
    return v + Vec3{size * noise(), size * noise(), size * noise()};
  };
  serial::WristReading& wrist = sensors_.wrist;
  wrist.on_arm.force_N = quantised(noisy(felt.force_N + case_.bias_N, case_.noise_N), 0.02);
  wrist.on_arm.torque_Nm = quantised(noisy(felt.torque_Nm, 0.5 * case_.noise_N), 0.01);
  ++wrist.sequence;
  wrist.status = serial::WristStatus::kGood;
  wrist.age_ticks = 0;
  serial::AdapterReading& adapter = sensors_.adapter;
  if (now_ % 4 == 0) {
    ++adapter.sequence;
    adapter.captured = adapter_.captured() ? 1 : 0;
    adapter.latch = adapter_.latched() ? serial::CatchState::kClosed : serial::CatchState::kOpen;
    for (std::size_t k = 0; k < 3; ++k)
      adapter.depth_01mm[k] =
          static_cast<std::uint8_t>(std::clamp(std::round(1e4 * adapter_.depth_m()[k]), 0.0, 255.0));
    adapter.age_ticks = 0;
  } else if (adapter.age_ticks != serial::kNeverHeard) {
    ++adapter.age_ticks;
  }
  inputs_.sensors = sensors_;
  if (meddle_) meddle_(inputs_.sensors);
}

void ForceRig::move_plant() {
  std::vector<bench::RotorDrive> drives(7);
  for (int step = 0; step < kStepsInTick; ++step) {
    for (std::size_t i = 0; i < 7; ++i) {
      const bool enabled = out_.drive[i].controlword == kEnableOperation &&
                           decode(inputs_.drive[i].statusword) == DriveState::kOperationEnabled;
      if (!enabled) {
        drives[i] = {};
        loop_[i].reset();
      } else if (step % kStepsInLoop == 0) {
        const serial::DriveParams& drive = robot_.table.drive[i];
        const bench::TorqueTarget target{drive.direction * out_.drive[i].torque_permille * drive.torque_per_permille_Nm,
                                         drive.direction * out_.drive[i].rate_counts_s * drive.rad_per_count};
        bench::TorqueGains gains;
        if (i >= 4) gains.damping_Nms_rad = 1500.0;  // the wrist
        drives[i].is_torque_controlled = true;
        drives[i].torque_Nm = loop_[i].step(0.001, gains, target, {chain_->gear_Nm(i), chain_->rotor_rate_rad_s(i)},
                                            model_.peak_torque_Nm);
      }
    }
    chain_->step(bench::FlexibleChain::kStep_s, drives,
                 [this](const bench::TipState& tip) { return load_on_tip(tip); });
    socket_in_root_ = beyond(socket_in_root_, {0.0, 0.0, socket_m_s_ * bench::FlexibleChain::kStep_s});
    adapter_.step(bench::FlexibleChain::kStep_s, plate());
  }
}

// What was told in the last tick acts while the Controller thinks about what was read at its end.
const serial::Outputs& ForceRig::tick(Request request) {
  read_drives();
  read_sensors();
  inputs_.tick = now_;
  inputs_.request = request;
  inputs_.telecommand = {};
  const auto interval = static_cast<std::uint64_t>(robot_.table.interval_ticks);
  if (asked_ && now_ % interval == 0)
    inputs_.telecommand = Release::make(++sequence_, now_, now_ + interval, 1, *asked_);
  move_plant();
  out_ = controller_.tick(inputs_);
  ++now_;
  return out_;
}

void ForceRig::run_s(double seconds) {
  const auto ticks = static_cast<int>(std::lround(seconds / robot_.table.tick_s));
  for (int i = 0; i < ticks; ++i) tick();
}

void ForceRig::enable() {
  run_s(0.3);
  tick(Request::kEnable);
  run_s(0.7);
  ASSERT_EQ(out_.state, OperatingState::kEnabled);
  ASSERT_EQ(out_.faults.count, 0);
}

serial::Setpoint ForceRig::push(double force_N, serial::InsertLaw law) {
  serial::Setpoint setpoint;
  setpoint.kind = CommandKind::kPush;
  setpoint.push.number = static_cast<std::uint32_t>(now_);
  setpoint.push.law = law;
  setpoint.push.force_N = force_N;
  setpoint.push.travel_m = 0.06;
  setpoint.push.aside_m = case_.most_aside_m;
  setpoint.push.turn_rad = 0.05;
  if (law == serial::InsertLaw::kImpedance) setpoint.push.depth_m = case_.before_m + 0.0222;
  setpoint.push.gains = robot_.push_gains;
  return setpoint;
}

double ForceRig::max_gear_Nm() const {
  double most = 0.0;
  for (std::size_t i = 0; i < 7; ++i) most = std::max(most, std::fabs(chain_->gear_Nm(i)));
  return most;
}

double ForceRig::base_moved_m() const { return bench::norm(chain_->base().pose.position_m - base_start_m_); }

}  // namespace liana::test
