#include "hil/payload/wrist_sensor.hpp"

#include <algorithm>
#include <cmath>

namespace liana::bench {

namespace {

std::uint8_t low(std::int16_t value) { return static_cast<std::uint8_t>(value & 0xFF); }
std::uint8_t high(std::int16_t value) { return static_cast<std::uint8_t>((value >> 8) & 0xFF); }

// Whole steps, within the full scale; true where that cut it.
bool digitise(const Vec3& value, double step, double full, std::array<std::int16_t, 3>& out) {
  const double axes[3] = {value.x, value.y, value.z};
  bool cut = false;
  for (std::size_t k = 0; k < 3; ++k) {
    cut = cut || std::fabs(axes[k]) > full;
    out[k] = static_cast<std::int16_t>(std::lround(std::clamp(axes[k], -full, full) / step));
  }
  return cut;
}

Vec3 uniform(Random& random, double most) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

}  // namespace

WristSensor::WristSensor(std::uint8_t bus, bool spread, std::uint64_t seed, const WristParams& figures)
    : figures_(figures), noise_(seed, "wrist sensor"), node_(kNode, bus) {
  if (!spread) return;
  Random bias(seed, "wrist bias");
  bias_ = {uniform(bias, figures_.force_bias_N), uniform(bias, figures_.torque_bias_Nm)};
}

WristReading WristSensor::read(const TipLoad& load) {
  TipLoad felt{load.force_N + bias_.force_N + gaussian(noise_, figures_.force_noise_N),
               load.torque_Nm + bias_.torque_Nm + gaussian(noise_, figures_.torque_noise_Nm)};
  if (defects_.saturated) felt.force_N.z = std::copysign(2.0 * figures_.force_full_N, felt.force_N.z);
  WristReading reading;
  const bool of_force = digitise(felt.force_N, figures_.force_step_N, figures_.force_full_N, reading.force);
  const bool of_torque = digitise(felt.torque_Nm, figures_.torque_step_Nm, figures_.torque_full_Nm, reading.torque);
  if (of_force || of_torque) reading.status = WristStatus::kSaturated;
  if (defects_.failed) reading = {{}, {}, WristStatus::kFailed};
  if (defects_.stuck) return last_;
  last_ = reading;
  return reading;
}

void WristSensor::report(const WristReading& reading, FrameList& out) {
  ++sequence_;
  const auto status = static_cast<std::uint8_t>(reading.status);
  const auto& [fx, fy, fz] = reading.force;
  const auto& [tx, ty, tz] = reading.torque;
  const std::array force{low(fx), high(fx), low(fy), high(fy), low(fz), high(fz), sequence_, status};
  const std::array torque{low(tx), high(tx), low(ty), high(ty), low(tz), high(tz), sequence_, status};
  node_.send(0x180 + kNode, force, out);
  node_.send(0x280 + kNode, torque, out);
}

void WristSensor::exchange(const FrameList& frames, std::uint64_t now_us, const TipLoad& load, FrameList& out) {
  FrameList said;
  for (const CanFrame& frame : frames)
    if (node_.hears(frame) && frame.id == 0x080 && node_.is_operational()) report(read(load), said);
  node_.tick(now_us, said);
  if (!defects_.silent) out.insert(out.end(), said.begin(), said.end());
}

}  // namespace liana::bench
