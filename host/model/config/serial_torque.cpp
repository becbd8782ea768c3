#include "host/model/config/serial_torque.hpp"

#include <stdexcept>
#include <utility>

#include "host/model/config/drive_names.hpp"
#include "host/model/config/drive_types_of_buses.hpp"
#include "host/model/config/robot_parts.hpp"

namespace liana::config {
namespace {

constexpr Range kGain{0, 1e6, true};

// One gain: { what a push has, least, most }.
void read_gain(const Field& field, std::size_t gain, SerialRobotConfig& out) {
  field.size(3, 3, "give what a push has that says nothing of it, the least and the most that one may ask for");
  serial::TorqueParams& torque = out.table.torque;
  torque.gain_low[gain] = field.element(1).number(kGain);
  torque.gain_high[gain] = field.element(2).number({torque.gain_low[gain], kGain.high});
  out.push_gains[gain] = field.element(0).number({torque.gain_low[gain], torque.gain_high[gain]});
}

void read_gains(const Field& gains, SerialRobotConfig& out) {
  gains.only({kPushGainNames.begin(), kPushGainNames.end()});
  for (std::size_t i = 0; i < kPushGainNames.size(); ++i) read_gain(gains.at(kPushGainNames[i]), i, out);
}

void read_force_control(const Field& field, SerialRobotConfig& out) {
  field.only(
      {"max_force_N", "max_joint_Nm", "max_travel_m", "max_lateral_m", "max_turn_deg", "wrist_still_samples", "gains"});
  serial::TorqueParams& torque = out.table.torque;
  torque.most_force_N = field.at("max_force_N").number({1, 1e5});
  torque.most_joint_Nm = field.at("max_joint_Nm").number({1, out.rated_torque_Nm});
  torque.most_travel_m = field.at("max_travel_m").number({0.001, 1});
  torque.most_aside_m = field.at("max_lateral_m").number({0.001, 1});
  torque.most_turn_rad = field.at("max_turn_deg").number({0.1, 45}) * kDegree;
  torque.wrist_still_samples = static_cast<std::uint16_t>(field.at("wrist_still_samples").integer(0, 10000));
  read_gains(field.at("gains"), out);
}

}  // namespace

void read_torque(const Field& table, SerialRobotConfig& out) {
  const Field drives = table.at("drives");
  const bool says_mode = drives.json().contains("mode");
  const bool gives = says_mode && drives.at("mode").choice({"position", "torque"}) == "torque";
  for (const auto& [field, key] : {std::pair{table, "force_control"}, std::pair{drives, "position_gain_per_s"}}) {
    if (!gives && field.json().contains(key))
      field.at(key).refuse("nothing here while drives.mode is not \"torque\"",
                           "say drives.mode = \"torque\" for drives that follow torques, or leave it out");
  }
  if (!gives) return;
  serial::TorqueParams& torque = out.table.torque;
  torque.is_torque_controlled = 1;
  torque.masses = out.masses;
  const Field friction = table.at("friction");
  torque.coulomb_Nm = friction.at("coulomb_Nm").number({0, 1e5});
  torque.viscous_Nms_per_rad = friction.at("viscous_Nms_per_rad").number({0, 1e5});
  torque.position_gain_per_s = drives.at("position_gain_per_s").number({0.001, 20});
  read_force_control(table.at("force_control"), out);
}

void check_drive_modes(const SerialRobotConfig& robot, const std::string& file, const BusesConfig& buses) {
  const std::map<std::int32_t, DriveType> types = drive_types(buses);
  const bool torque = is_torque_controlled(robot);
  const std::vector<DrivePlace> places = buses.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto named = types.find(places[i].node);
    if ((named != types.end() && named->second.is_cst) == torque) continue;
    const std::string type = named != types.end() ? named->second.name : "cia402_csp";
    throw std::runtime_error(file + ": drives.mode: \"" + (torque ? "torque" : "position") +
                             "\": allowed is the mode of the drives' types, but " + drive_text(i, places[i]) +
                             " of bus table " + buses.name + " is a " + type + ": " +
                             (torque ? "use buses whose drives follow torques, as embedded_payload"
                                     : "use buses whose drives follow positions, as embedded_micro"));
  }
}

}  // namespace liana::config
