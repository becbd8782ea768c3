// What a TorquePlant writes into truth and summary.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hil/payload/torque_plant.hpp"
#include "hil/serial/link_axis.hpp"

namespace liana::bench {

namespace {

constexpr const char* kHolders[] = {"mechanism", "arm", "adapter"};

void add_vector(std::vector<double>& row, const Vec3& v) { row.insert(row.end(), {v.x, v.y, v.z}); }

}  // namespace

std::vector<std::string> TorquePlant::truth_columns() const {
  std::vector<std::string> columns;
  for (std::size_t i = 1; i <= drives_.size(); ++i) columns.push_back("joint_deg_" + std::to_string(i));
  for (const char* name : {"tip_x_m", "tip_y_m", "tip_z_m", "tip_qw", "tip_qx", "tip_qy", "tip_qz"})
    columns.emplace_back(name);
  for (std::size_t i = 1; i <= drives_.size(); ++i) columns.push_back("torque_Nm_" + std::to_string(i));
  columns.emplace_back("enabled");
  for (const char* name :
       {"wrist_fx_N", "wrist_fy_N", "wrist_fz_N", "wrist_tx_Nm", "wrist_ty_Nm", "wrist_tz_Nm", "base_deflection_m"})
    columns.emplace_back(name);
  if (has_bodies(scene_)) columns.emplace_back("clearance_m");
  if (!site_) return columns;
  for (const char* name :
       {"contact_x_N", "contact_y_N", "contact_z_N", "contact_peak_N", "plate_x_m", "plate_y_m", "plate_z_m",
        "plate_tilt_deg", "depth_m_1", "depth_m_2", "depth_m_3", "captured", "latch", "lock", "holder"})
    columns.emplace_back(name);
  return columns;
}

void TorquePlant::add_truth(std::vector<double>& row) {
  for (const double joint : joints_rad()) row.push_back(kDegPerRad * joint);
  const Pose pose = tip();
  add_vector(row, pose.position_m);
  row.insert(row.end(), {pose.attitude.w, pose.attitude.x, pose.attitude.y, pose.attitude.z});
  for (std::size_t i = 0; i < chain_.joints(); ++i) row.push_back(chain_.gear_Nm(i));
  row.push_back(static_cast<double>(drives_.enabled()));
  add_vector(row, wrist_load_.force_N);
  add_vector(row, wrist_load_.torque_Nm);
  row.push_back(base_deflection_m());
  if (has_bodies(scene_)) row.push_back(nearest_body_m());
  if (site_) add_site_truth(row);
  contact_peak_N_ = 0.0;
}

double TorquePlant::nearest_body_m() const {
  const auto to_bodies = [&](std::vector<Vec3> axis_m, double radius_m) {
    for (Vec3& point : axis_m) point = relative(base_at_rest_, {point, {}}).position_m;
    return clearance_m(axis_m, scene_, radius_m);
  };
  const double of_arm = to_bodies(chain_.axis_m(), arm_.robot.link_radius_m);
  if (!site_ || site_->holder() != Holder::kArm) return of_arm;
  const Pose tip = chain_.tip().pose;
  const std::vector<Vec3> held{site_->payload(tip).position_m, site_->plate(tip).position_m};
  return std::min(of_arm, to_bodies(held, scene_.payload->radius_m));
}

void TorquePlant::add_site_truth(std::vector<double>& row) const {
  const Pose plate = site_->plate_in_socket(chain_.tip().pose);
  const Adapter& adapter = site_->adapter();
  add_vector(row, contact_N_);
  row.push_back(contact_peak_N_);
  add_vector(row, plate.position_m);
  row.push_back(kDegPerRad * angle_of(plate.attitude));
  row.insert(row.end(), adapter.depth_m().begin(), adapter.depth_m().end());
  row.push_back(adapter.captured() ? 1.0 : 0.0);
  row.push_back(static_cast<double>(adapter.latch()));
  row.push_back(static_cast<double>(adapter.lock()));
  row.push_back(static_cast<double>(site_->holder()));
}

void TorquePlant::summarise(nlohmann::json& summary) const {
  nlohmann::json zeros = nlohmann::json::array();
  for (const double offset : arm_.zero_offset_rad) zeros.push_back(kDegPerRad * offset);
  summary["arm"] = "serial";
  summary["true_parameters"] = {{"zero_offset_deg", zeros}};
  summary["peaks"] = {{"joint_torque_Nm", peaks_.joint_Nm}, {"base_deflection_m", peaks_.base_m}};
  if (!site_) return;
  const Pose plate = site_->plate_in_socket(chain_.tip().pose);
  summary["peaks"]["contact_N"] = peaks_.contact_N;
  summary["peaks"]["lateral_N"] = peaks_.lateral_N;
  summary["peaks"]["insertion_m"] = peaks_.insertion_m;
  summary["payload"] = {{"holder", kHolders[static_cast<std::size_t>(site_->holder())]},
                        {"captured_s", nullptr},
                        {"latch", static_cast<int>(site_->adapter().latch())},
                        {"lock", static_cast<int>(site_->adapter().lock())},
                        {"plate_m", {plate.position_m.x, plate.position_m.y, plate.position_m.z}},
                        {"plate_tilt_deg", kDegPerRad * angle_of(plate.attitude)}};
  if (captured_s_) summary["payload"]["captured_s"] = *captured_s_;
}

}  // namespace liana::bench
