#include "host/operator/simulated/own_devices.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace liana::simulated {

namespace {

constexpr double kStepsPerMetre = 1e6, kStepsOfQuaternion = 1e8;  // what such devices resolve

double rounded(double value, double steps_per_unit) { return std::round(value * steps_per_unit) / steps_per_unit; }

device::Sample resolved(device::Sample sample) {
  for (double& x : sample.pose.position_m) x = rounded(x, kStepsPerMetre);
  for (double& q : sample.pose.quaternion) q = rounded(q, kStepsOfQuaternion);
  return sample;
}

liana_hand hand_within(double x_m, double y_m, double z_m) {
  return {LIANA_ALL_AXES, 0, 0, 0, {-x_m, -y_m, -z_m}, {x_m, y_m, z_m}, 0.0, 0.0};
}

void require_open(const device::Driver& driver) {
  if (!driver.is_open()) throw std::runtime_error("a device of the operator: " + driver.problem());
}

}  // namespace

device::Capability recorded_handles() {
  const liana_hand arm_length = hand_within(1.0, 1.0, 1.0);
  return {"operator-handles", device::Kind::kVrControllers, 2, 90.0, 0.1, {arm_length, arm_length}};
}

device::Capability simulated_controller() {
  return {"operator-controller", device::Kind::kHandController, 1, 1000.0, 0.1, {hand_within(0.055, 0.08, 0.08)}};
}

OwnDevices::OwnDevices(const std::string& path, double timeout_s)
    : handles_(device::Driver::connect(path, recorded_handles(), 0, timeout_s)),
      controller_(device::Driver::connect(path, simulated_controller(), 0, timeout_s)) {}

void OwnDevices::send(device::Kind kind, const std::vector<device::Sample>& samples) {
  device::Driver& driver = kind == device::Kind::kVrControllers ? handles_ : controller_;
  std::vector<device::Sample> out(samples.size());
  std::transform(samples.begin(), samples.end(), out.begin(), resolved);
  driver.send(out);
  require_open(driver);
}

void OwnDevices::receive(std::int64_t now_us) {
  for (device::Driver* driver : {&handles_, &controller_}) {
    driver->receive(now_us);
    require_open(*driver);
  }
}

void OwnDevices::leave() {
  for (device::Driver* driver : {&handles_, &controller_}) driver->leave();
}

}  // namespace liana::simulated
