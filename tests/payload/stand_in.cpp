#include "tests/payload/stand_in.hpp"

#include <algorithm>
#include <cmath>

#include "hil/math/reduced.hpp"

namespace liana::test {

using bench::CanFrame;
using bench::FrameList;

namespace {

constexpr double kMass[6] = {500, 500, 500, 100, 100, 100};
constexpr double kDamping[6] = {3000, 3000, 4000, 1500, 1500, 1500};
constexpr double kDead[6] = {1, 1, 0, 0.5, 0.5, 0.5};
constexpr double kFilter_s = 0.1;
constexpr double kCountsPerRad = 1048576.0 / 6.283185307179586;
constexpr double kRated_Nm = 150.0;

std::uint8_t bus_of(std::size_t i) { return i < 4 ? 0 : 1; }

std::int64_t signed_at(const CanFrame& frame, std::size_t at, std::size_t bytes) {
  std::uint64_t raw = 0;
  for (std::size_t k = bytes; k-- > 0;) raw = (raw << 8U) | frame.data[at + k];
  const std::uint64_t sign = 1ULL << (8 * bytes - 1);
  return static_cast<std::int64_t>((raw ^ sign) - sign);
}

double beyond(double value, double dead) { return std::copysign(std::max(0.0, std::fabs(value) - dead), value); }

bench::Vec3 own(const Vec3& v) { return {v[0], v[1], v[2]}; }

// Rows of the plate's Jacobian in the tip's frame.
using Rows = std::array<std::array<double, 7>, 6>;

Rows plate_jacobian(const serial::RobotParams& table, double plate_m, const serial::JointVector& joint_rad) {
  const serial::ArmKinematics arm = serial::forward_kinematics(table, joint_rad);
  const auto& q = arm.tip_in_base.quaternion;  // w first
  const bench::Quat into_tip = conjugate(bench::Quat{q[0], q[1], q[2], q[3]});
  Rows rows{};
  for (std::size_t i = 0; i < 7; ++i) {
    const bench::Vec3 w = rotate(into_tip, own(arm.tip_jacobian.angular[i]));
    const bench::Vec3 v = rotate(into_tip, own(arm.tip_jacobian.linear[i])) + cross(w, {0.0, 0.0, plate_m});
    const double column[6] = {v.x, v.y, v.z, w.x, w.y, w.z};
    for (std::size_t k = 0; k < 6; ++k) rows[k][i] = column[k];
  }
  return rows;
}

serial::JointVector min_rates(const Rows& rows, const std::array<double, 6>& twist) {
  bench::ThetaMatrix square{};
  bench::Theta right{}, x{};
  for (std::size_t r = 0; r < 6; ++r) {
    right[r] = twist[r];
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t i = 0; i < 7; ++i) square[r][c] += rows[r][i] * rows[c][i];
    square[r][r] += 1e-6;
  }
  bench::solve_spd(square, right, 6, x);
  serial::JointVector rate{};
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t r = 0; r < 6; ++r) rate[i] += rows[r][i] * x[r];
  return rate;
}

}  // namespace

TorqueCommand ForceLaw::step(double tick_s, const serial::JointVector& joint_rad, const bench::Vec3& force_N,
                             const bench::Vec3& torque_Nm) {
  const Rows rows = plate_jacobian(table_, plate_m_, joint_rad);
  const bench::Vec3 at_plate = torque_Nm - cross({0.0, 0.0, plate_m_}, force_N);
  const double met[6] = {force_N.x, force_N.y, force_N.z, at_plate.x, at_plate.y, at_plate.z};
  TorqueCommand command;
  for (std::size_t k = 0; k < 6; ++k) {
    const double wanted = k == 2 ? set_N + met[2] : beyond(met[k], kDead[k]);
    const double decay = tick_s * kDamping[k] / kMass[k];
    velocity_[k] = (velocity_[k] + tick_s * wanted / kMass[k]) / (1.0 + decay);
    met_[k] += tick_s / kFilter_s * (met[k] - met_[k]);
    if (!feed_forward) continue;
    for (std::size_t i = 0; i < 7; ++i) command.feed_forward_Nm[i] -= rows[k][i] * met_[k];
  }
  command.rate_rad_s = min_rates(rows, velocity_);
  return command;
}

Stand::Stand(std::uint64_t seed, const std::string& faults, bool spread, const Json& scene)
    : robot(config::parse_serial_robot(config::good_table("robot", "macro_micro").dump(), "r")),
      plant(
          bench_robot(torque_arm_table()), bench_scene(scene), bench_buses(),
          [spread] {
            bench::ModelOptions options;
            options.start_pose = "install";
            options.spread = spread;
            return options;
          }(),
          bench::load_faults(written(Json::parse(faults), "faults"), 7, 7), seed),
      injector_(bench::load_faults(written(Json::parse(faults), "faults"), 7, 7)),
      law_(robot.table, scene.contains("payload") ? scene["payload"]["length_m"].get<double>() : 0.0) {}

void Stand::say(std::uint32_t id, std::vector<std::uint8_t> bytes, std::uint8_t bus) {
  CanFrame frame;
  frame.id = id;
  frame.bus = bus;
  frame.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  extra_.push_back(frame);
}

void Stand::configure() {
  struct Write {
    unsigned index, sub, size;
    std::uint32_t value;
  };
  for (std::uint32_t node = 1; node <= 7; ++node) {
    const std::uint32_t damping = node > 4 ? 1500 : 3000;
    const Write writes[] = {{0x1400, 1, 4, 0x80000200 + node},
                            {0x1600, 0, 1, 0},
                            {0x1600, 1, 4, 0x60400010},
                            {0x1600, 2, 4, 0x60710010},
                            {0x1600, 3, 4, 0x60B10020},
                            {0x1600, 0, 1, 3},
                            {0x1400, 5, 2, 12},
                            {0x1400, 1, 4, 0x200 + node},
                            {0x1800, 1, 4, 0x80000180 + node},
                            {0x1A00, 0, 1, 0},
                            {0x1A00, 1, 4, 0x60410010},
                            {0x1A00, 2, 4, 0x60640020},
                            {0x1A00, 3, 4, 0x60770010},
                            {0x1A00, 0, 1, 3},
                            {0x1800, 2, 1, 1},
                            {0x1800, 1, 4, 0x180 + node},
                            {0x1801, 1, 4, 0x80000280 + node},
                            {0x1A01, 0, 1, 0},
                            {0x1A01, 1, 4, 0x606C0020},
                            {0x1A01, 0, 1, 1},
                            {0x1801, 2, 1, 1},
                            {0x1801, 1, 4, 0x280 + node},
                            {0x6060, 0, 1, 10},
                            {0x6072, 0, 2, 2000},
                            {0x3001, 1, 4, damping}};
    for (const Write& w : writes) {
      std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(0x23U | ((4U - w.size) << 2U)),
                                      static_cast<std::uint8_t>(w.index), static_cast<std::uint8_t>(w.index >> 8),
                                      static_cast<std::uint8_t>(w.sub)};
      for (unsigned k = 0; k < 4; ++k) bytes.push_back(static_cast<std::uint8_t>(w.value >> (8 * k)));
      say(0x600 + node, bytes, bus_of(node - 1));
    }
    say(0x000, {0x01, static_cast<std::uint8_t>(node)}, bus_of(node - 1));
  }
}

void Stand::hear(const CanFrame& frame) {
  const std::uint32_t node = frame.id & 0x7F;
  const bool is_drive = node >= 1 && node <= 7;
  if (is_drive && (frame.id & 0x780) == 0x180 && frame.length == 8) {
    const std::size_t i = node - 1;
    heard.statusword[i] = static_cast<int>(signed_at(frame, 0, 2)) & 0xFFFF;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    heard.joint_rad[i] = sign * (static_cast<double>(signed_at(frame, 2, 4)) - 1e6) / kCountsPerRad;
    heard.torque_permille[i] = static_cast<int>(signed_at(frame, 6, 2));
  }
  if (frame.id == 0x1A0) {
    ++heard.wrist_frames;
    heard.force_N = {0.02 * static_cast<double>(signed_at(frame, 0, 2)),
                     0.02 * static_cast<double>(signed_at(frame, 2, 2)),
                     0.02 * static_cast<double>(signed_at(frame, 4, 2))};
    heard.wrist_status = frame.data[7];
  }
  if (frame.id == 0x2A0)
    heard.torque_Nm = {0.01 * static_cast<double>(signed_at(frame, 0, 2)),
                       0.01 * static_cast<double>(signed_at(frame, 2, 2)),
                       0.01 * static_cast<double>(signed_at(frame, 4, 2))};
  if (frame.id != 0x1B0) return;
  ++heard.adapter_frames;
  heard.captured = frame.data[1] == 1;
  heard.latch = frame.data[2];
  heard.lock = frame.data[3];
  for (std::size_t k = 0; k < 3; ++k) heard.depth_m[k] = 1e-4 * frame.data[4 + k];
}

void Stand::ask(const TorqueCommand& command) {
  FrameList frames;
  for (std::size_t i = 0; i < 7; ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const auto permille =
        static_cast<std::int16_t>(std::lround(sign * 1000.0 * command.feed_forward_Nm[i] / kRated_Nm));
    const auto rate = static_cast<std::int32_t>(std::lround(sign * command.rate_rad_s[i] * kCountsPerRad));
    CanFrame frame;
    frame.id = 0x201 + static_cast<std::uint32_t>(i);
    frame.bus = bus_of(i);
    frame.length = 8;
    bench::put_little_endian(&frame.data[0], 2, static_cast<std::uint64_t>(controlword));
    bench::put_little_endian(&frame.data[2], 2, static_cast<std::uint16_t>(permille));
    bench::put_little_endian(&frame.data[4], 4, static_cast<std::uint32_t>(rate));
    frames.push_back(frame);
  }
  on_the_way_.push_back(frames);
}

void Stand::tick(const TorqueCommand& command, bool silent) {
  ask(command);
  FrameList in;
  std::swap(in, extra_);
  if (on_the_way_.size() > 1) {
    if (!silent) in.insert(in.end(), on_the_way_.front().begin(), on_the_way_.front().end());
    on_the_way_.pop_front();
  }
  const std::uint64_t now_us = 4000ULL * slot_ + 50;
  for (const std::uint8_t bus : {std::uint8_t{0}, std::uint8_t{1}}) {
    CanFrame sync;
    sync.id = 0x080;
    sync.bus = bus;
    in.push_back(sync);
  }
  for (CanFrame& frame : in) frame.time_us = now_us;
  plant.inject(slot_, injector_);
  std::vector<double> row;
  plant.add_truth(row);
  last_out.clear();
  plant.exchange(in, now_us, last_out);
  for (const CanFrame& frame : last_out) hear(frame);
  plant.integrate(kTick_s);
  for (std::size_t i = 0; i < 7; ++i) peak_Nm = std::max(peak_Nm, std::fabs(plant.arm().gear_Nm(i)));
  ++slot_;
}

void Stand::press(double set_N, bool unload) {
  law_.set_N = set_N;
  law_.feed_forward = !unload;
  tick(law_.step(kTick_s, heard.joint_rad, heard.force_N - tare_N_, heard.torque_Nm - tare_Nm_));
}

void Stand::start() {
  tick({});
  configure();
  tick({});
  for (const int word : {0x06, 0x07, 0x0F}) {
    controlword = word;
    for (int i = 0; i < 4; ++i) tick({});
  }
  constexpr int kReadings = 50;
  bench::Vec3 force, torque;
  for (int i = 0; i < kReadings; ++i) {
    tick({});
    force = force + (1.0 / kReadings) * heard.force_N;
    torque = torque + (1.0 / kReadings) * heard.torque_Nm;
  }
  tare_N_ = force;
  tare_Nm_ = torque;
}

}  // namespace liana::test
