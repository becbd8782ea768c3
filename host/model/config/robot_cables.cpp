// Cables and drives of a robot table.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/model/config/canonical.hpp"
#include "host/model/config/robot_parts.hpp"

namespace liana::config {
namespace {

constexpr double kMaxTension_N = 1e5;

double read_friction(const Field& field, const std::string& physics) {
  field.only({"nominal", "ideal", "worn"});
  for (const char* name : {"nominal", "ideal", "worn"}) field.at(name).number({0, 0.5});
  if (!field.json().contains(physics)) {
    throw std::runtime_error(field.file() + ": physics: " + physics +
                             ": allowed nominal, ideal, worn: use one of these words");
  }
  return field.at(physics).number({0, 0.5});
}

void read_tension(const Field& field, cable::TensionLimits& tension) {
  field.only({"plan_N", "floor_motor_N", "floor_anywhere_N", "ceiling_free_N", "alarm_N", "hard_limit_N"});
  tension.floor_anywhere_N = field.at("floor_anywhere_N").number({0.001, kMaxTension_N});
  tension.floor_motor_N = field.at("floor_motor_N").number({tension.floor_anywhere_N, kMaxTension_N});
  tension.plan_N = field.at("plan_N").number({tension.floor_motor_N, kMaxTension_N, true});
  tension.ceiling_free_N = field.at("ceiling_free_N").number({tension.plan_N, kMaxTension_N, true});
  tension.alarm_N = field.at("alarm_N").number({tension.ceiling_free_N, kMaxTension_N, true});
  tension.hard_limit_N = field.at("hard_limit_N").number({tension.alarm_N, kMaxTension_N, true});
}

// Optional: a table without it gets the defaults.
void read_monitor(const Field& cables, cable::CableMonitorParams& monitor) {
  if (!cables.json().contains("monitor")) return;
  const Field field = cables.at("monitor");
  field.only({"jump_N", "contradiction_m"});
  if (field.json().contains("jump_N")) monitor.jump_N = field.at("jump_N").number({0.001, 1000});
  if (field.json().contains("contradiction_m"))
    monitor.contradiction_m = field.at("contradiction_m").number({1e-6, 0.1});
}

void read_drive_lists(const Field& drives, RobotConfig& out) {
  const auto count = static_cast<std::size_t>(out.table.cable_count());
  const Field direction = drives.at("direction");
  const Field zero = drives.at("zero_counts");
  direction.size(count, count,
                 "one entry per drive: slide and roll of a base, then the cables, those of the first segment first");
  zero.size(count, count,
            "one entry per drive: slide and roll of a base, then the cables, those of the first segment first");
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t sign = direction.element(i).integer(-1, 1);
    if (sign == 0) direction.element(i).refuse("1 or -1", "1 when counts grow while cable is paid out");
    out.table.drive[i].direction = static_cast<std::int32_t>(sign);
    out.table.drive[i].zero_counts = static_cast<std::int32_t>(zero.element(i).integer(-1000000000, 1000000000));
    out.table.drive[i].metres_per_count = 2.0 * std::numbers::pi * out.drum_radius_m / (out.counts_per_turn * out.gear);
    out.table.drive[i].newtons_per_permille = out.rated_torque_Nm / out.drum_radius_m / 1000.0;
  }
}

}  // namespace

void read_cables(const Field& table, const std::string& physics, RobotConfig& out) {
  const Field cables = table.at("cables");
  cables.only(
      {"hole_radius_m", "face_offset_m", "phase_deg", "EA_N", "lead_m", "friction_mu", "friction_band", "monitor"});
  out.table.cable_EA_N = cables.at("EA_N").number({1000, 1e8});
  out.table.lead_m = cables.at("lead_m").number({0.01, 10});
  out.table.friction_mu = read_friction(cables.at("friction_mu"), physics);
  if (cables.json().contains("friction_band")) out.friction_band = cables.at("friction_band").number({0, 1});
  read_tension(table.at("tension"), out.table.tension);
  read_monitor(cables, out.table.cable_monitor);
}

void read_torque_zero(const Field& drives, cable::TorqueZeroTable& zero) {
  if (!drives.json().contains("torque_zero")) return;
  const Field field = drives.at("torque_zero");
  field.only({"bias_N", "drift_N_h"});
  if (field.json().contains("bias_N")) zero.bias_N = field.at("bias_N").number({0, 100});
  if (field.json().contains("drift_N_h")) zero.drift_N_h = field.at("drift_N_h").number({0, 100});
}

void read_drives(const Field& table, RobotConfig& out) {
  const Field drives = table.at("drives");
  drives.only({"drum_radius_m", "counts_per_turn", "gear", "servo_time_constant_s", "rated_torque_Nm", "identity",
               "direction", "zero_counts", "serials", "calibration_days", "torque_zero"});
  out.drum_radius_m = drives.at("drum_radius_m").number({0.001, 0.5});
  out.counts_per_turn = static_cast<std::uint32_t>(drives.at("counts_per_turn").integer(256, 16777216));
  out.gear = drives.at("gear").number({0.01, 1000});
  out.table.servo_time_constant_s = drives.at("servo_time_constant_s").number({0.001, 1});
  out.rated_torque_Nm = drives.at("rated_torque_Nm").number({0.01, 4000});
  const double needed_Nm = out.table.tension.hard_limit_N * out.drum_radius_m;
  if (out.rated_torque_Nm < needed_Nm * (1 - 1e-9)) {
    drives.at("rated_torque_Nm")
        .refuse("at least " + canonical_number(needed_Nm) + " (tension.hard_limit_N times drum_radius_m)",
                "choose a stronger drive or a lower limit");
  }
  out.identity = read_identity(drives.at("identity"));
  out.calibration_days = read_calibration_days(drives);
  read_torque_zero(drives, out.table.torque_zero);
  read_drive_lists(drives, out);
  out.drive_serials = read_serials(drives, static_cast<std::size_t>(out.table.cable_count()));
}

}  // namespace liana::config
