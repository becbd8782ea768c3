#include "host/operator/station/run_statistics.hpp"

#include <algorithm>

#include "host/base/json/json.hpp"

namespace liana::station {
namespace {

Vec3 position_in(const Json& list) { return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()}; }

Json lag_json(const LagStatistics& lag) {
  if (!lag.median_s) return nullptr;
  return {{"median", *lag.median_s}, {"worst", *lag.worst_s}};
}

Json errors_json(std::vector<double> errors_m) {
  if (errors_m.empty()) return nullptr;
  std::sort(errors_m.begin(), errors_m.end());
  return {{"median", errors_m[errors_m.size() / 2]}, {"worst", errors_m.back()}};
}

}  // namespace

void RunStatistics::sent(const simulated::OperatorAnswer& answer) {
  const auto moves_tip = [](const device::Sample& sample) { return sample.hand == 0 && sample.valid; };
  const auto newest = std::find_if(answer.samples.rbegin(), answer.samples.rend(), moves_tip);
  if (newest == answer.samples.rend()) return;
  lag_.hand(1e-6 * static_cast<double>(newest->t_us), newest->deadman, newest->pose.position_m, scale_);
}

void RunStatistics::arm(const Json& state) {
  scale_ = simulated::announced_mapping(state).scale;
  if (!state.contains("setpoint_cp") || !state["setpoint_cp"].is_array() || !state.contains("measured_cp")) return;
  lag_.arm(state.at("time_s").get<double>(), state.value("device_engaged", false), position_in(state["setpoint_cp"]),
           position_in(state["measured_cp"]));
}

Json RunStatistics::json(const std::optional<HandMotionParams>& hand) const {
  Json figures{
      {"hand_to_tip_lag_s", {{"commanded", lag_json(lag_.commanded())}, {"measured", lag_json(lag_.measured())}}}};
  if (!hand) return figures;
  figures["peak_hand_force_N"] = hand->peak_force_N;
  figures["min_port_energy_J"] = hand->min_energy_J;
  figures["prediction_error_m"] = errors_json(hand->errors_m);
  return figures;
}

}  // namespace liana::station
