#include "host/apps/report/push_loads.hpp"

#include <cmath>

#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

// Of each axis the largest amount so far.
void raise(Vec3& most, const Vec3& value) {
  for (std::size_t i = 0; i < 3; ++i) most[i] = std::fmax(most[i], std::fabs(value[i]));
}

Json listed(const Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

void add_wrenches(Json& report, const TruthLog& truth, const Rows& rows) {
  Vec3 end_N{}, end_Nm{}, base_N{}, base_Nm{};
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    const Vec3 force_N{truth.at(row, "wrist_fx_N"), truth.at(row, "wrist_fy_N"), truth.at(row, "wrist_fz_N")};
    const Vec3 torque_Nm{truth.at(row, "wrist_tx_Nm"), truth.at(row, "wrist_ty_Nm"), truth.at(row, "wrist_tz_Nm")};
    const Pose tip = truth.tip(row);
    const Vec3 in_base_N = rotate(tip.quaternion, force_N);
    raise(end_N, force_N);
    raise(end_Nm, torque_Nm);
    raise(base_N, in_base_N);
    raise(base_Nm, add(rotate(tip.quaternion, torque_Nm), cross(tip.position_m, in_base_N)));
  }
  report["end_force_N"] = listed(end_N);
  report["end_torque_Nm"] = listed(end_Nm);
  report["base_force_N"] = listed(base_N);
  report["base_torque_Nm"] = listed(base_Nm);
}

void add_margin(Json& report, const TruthLog& truth, std::size_t captured_row, double set_N) {
  const double resisted_N = -truth.at(captured_row, "contact_z_N");
  report["resisted_N"] = resisted_N;
  report["margin_N"] = set_N - resisted_N;
}

}  // namespace liana::report
