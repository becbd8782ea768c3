#include "host/control/server/recovery.hpp"

#include <algorithm>
#include <cstdio>

#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/cable/cable_arm.hpp"
#include "host/base/json/json.hpp"

namespace liana::server {
namespace {

using Index = std::size_t;
using Path = arbiter::PathHistory<cable::ThetaVector>;

constexpr Index kPlaces = 100;  // of the path that are planned for an arm with weight

std::string newtons(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f N", value);
  return text;
}

// What the core would do without, were it asked now.
cable::SegmentReleaseState loss_of(const LossView& arm, Index cable) {
  const std::int32_t segment = cable::may_let_go(arm.table) ? arm.names.segment_of(cable) - 1 : -1;
  return {cable::SegmentReleaseStage::kBroken, segment, static_cast<std::int32_t>(cable), cable::kLetGoSettleTicks};
}

// Only what has weight pulls at the cables that are left: they can pull, not push.
std::string why_not_held(const LossView& arm, Index lost, const cable::ThetaVector& theta_rad,
                         const std::string& where) {
  const cable::CableLayout layout = cable_layout(arm.table);
  const cable::ArmTrig trig = cable::arm_trig(arm.table, theta_rad);
  const cable::TensionPlan plan = cable::plan_without(
      arm.table, layout, cable_geometry(arm.table, layout, trig), tension_ratio(arm.table, layout, trig, {}),
      loss_of(arm, lost), static_load_Nm(arm.table, theta_rad, trig, forward_kinematics(arm.table, theta_rad)));
  for (Index c = static_cast<Index>(arm.table.feed_count()); c < static_cast<Index>(arm.table.cable_count()); ++c) {
    const double min_N = arm.table.tension.floor_motor_N, max_N = arm.table.tension.ceiling_free_N;
    if (c == lost || (plan.motor_N[c] >= min_N && plan.motor_N[c] <= max_N)) continue;
    return where + " " + arm.names.cable(c) + " would need " + newtons(plan.motor_N[c]) + ", allowed " +
           newtons(min_N) + " to " + newtons(max_N) + ": the weight cannot be held without " + arm.names.cable(lost) +
           ". Support the arm, then follow docs/how-to/a-cable-broke.md";
  }
  return "";
}

std::string why_weight_falls(const LossView& arm, Index lost, const Path& path) {
  if (cable::may_let_go(arm.table)) return "";
  std::string why = why_not_held(arm, lost, arm.outputs.theta_measured_rad, "where it stands");
  const Index step = std::max<Index>(1, path.size() / kPlaces);
  for (Index i = 0; i < path.size() && why.empty(); i += step) {
    const auto percent = static_cast<int>(100 * (i + 1) / path.size());
    why = why_not_held(arm, lost, path.at(path.size() - 1 - i).joint_rad,
                       "after " + std::to_string(percent) + " % of the path");
  }
  return why;
}

// A drive that is lost holds its cable with its brake, and nobody can pay that out: so much does a millimetre of way
// pull it.
std::string why_drive_holds(const LossView& arm) {
  for (Index i = 0; i < static_cast<Index>(arm.outputs.faults.count); ++i) {
    const Fault& fault = arm.outputs.faults.fault[i];
    const auto group = static_cast<int>(fault.number) / 1000;
    if (group != 3 || fault.index < arm.table.feed_count()) continue;
    const auto cable = static_cast<Index>(fault.index);
    const double per_mm_N = 1e-3 * arm.table.cable_EA_N / arm.outputs.payout_command_m[cable];
    return arm.names.drive(cable) + " is lost (fault " + std::to_string(static_cast<int>(fault.number)) +
           "): its brake holds its cable, and each millimetre of way would pull it by " + newtons(per_mm_N) +
           ". Bring the drive back, then liana clear; or slacken its drum by hand (docs/how-to/a-cable-broke.md)";
  }
  return "no cable is lost: fault 5006 is not latched; see docs/how-to/arm-stands-in-the-slit-with-a-fault.md";
}

// An arm whose path is at its end is out: what is left to do is the repair.
std::string next_after_clear(const Path& path, Index lost) {
  const std::string whole = "liana clear --whole " + std::to_string(lost + 1);
  return path.size() < 2 ? "replace the cable, then " + whole : "liana recover goes on; after a repair " + whole;
}

}  // namespace

std::vector<std::size_t> lost_cables(const LossView& arm) {
  std::vector<Index> lost;
  if (cable::does_without(arm.release)) lost.push_back(static_cast<Index>(arm.release.cable));
  for (Index i = 0; i < static_cast<Index>(arm.outputs.faults.count); ++i) {
    const Fault& fault = arm.outputs.faults.fault[i];
    if (fault.number == FaultNumber::kCableBreak) lost.push_back(static_cast<Index>(fault.index));
  }
  std::sort(lost.begin(), lost.end());
  lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
  return lost;
}

std::string why_loss_stands(const LossView& arm) {
  for (const Index cable : lost_cables(arm)) {
    const double tension_N = arm.outputs.tension_measured_N[cable];
    if (tension_N >= arm.table.tension.floor_motor_N) continue;
    return arm.names.cable(cable) + " takes no tension: " + newtons(tension_N) + ", a whole cable has at least " +
           newtons(arm.table.tension.floor_motor_N) +
           ". Lead the arm out with liana recover; if you have looked and the cable is whole, liana clear --whole " +
           std::to_string(cable + 1);
  }
  return "";
}

std::string why_not_recover(const LossView& arm, const Path& path) {
  const std::vector<Index> lost = lost_cables(arm);
  if (lost.empty()) return why_drive_holds(arm);
  for (const Index cable : lost) {
    const bool is_same =
        cable::may_let_go(arm.table) ? arm.names.segment_of(cable) == arm.names.segment_of(lost[0]) : cable == lost[0];
    if (is_same) continue;
    return arm.names.cable(lost[0]) + " and " + arm.names.cable(cable) +
           " are lost: an arm goes back without one cable, not two. Follow docs/how-to/a-cable-broke.md, by hand";
  }
  if (path.size() < 2) return "there is no stored path to go back along: follow docs/how-to/a-cable-broke.md, by hand";
  return why_weight_falls(arm, lost[0], path);
}

Json recovery_json(const LossView& arm, const Path& path) {
  const std::vector<Index> lost = lost_cables(arm);
  if (lost.empty()) return nullptr;
  Json cables = Json::array(), slack = Json::array();
  for (const Index cable : lost) cables.push_back(cable + 1);
  const cable::CableLayout layout = cable_layout(arm.table);
  const cable::SegmentReleaseState release = loss_of(arm, lost[0]);
  for (Index c = static_cast<Index>(arm.table.feed_count()); c < static_cast<Index>(arm.table.cable_count()); ++c)
    if (is_released(release, layout, c)) slack.push_back(c + 1);
  // The plan of an arm with weight is long: it is made when somebody asks.
  const bool recovers = cable::does_without(arm.release) && arm.outputs.faults.count == 0;
  return {{"cables", cables},      {"where", arm.names.drive(lost[0])},
          {"slack", slack},        {"recovers", recovers},
          {"points", path.size()}, {"next", recovers ? next_after_clear(path, lost[0]) : "liana recover"}};
}

std::string slack_cables(const LossView& arm) {
  const double needed_N = cable::kSlackCheckShare * arm.table.tension.floor_motor_N;
  const cable::CableLayout layout = cable_layout(arm.table);
  std::string text;
  for (Index c = static_cast<Index>(arm.table.feed_count()); c < static_cast<Index>(arm.table.cable_count()); ++c) {
    const double tension_N = arm.outputs.tension_measured_N[c];
    if (tension_N >= needed_N || is_released(arm.release, layout, c)) continue;
    text += (text.empty() ? "" : ", ") + arm.names.cable(c) + " has " + newtons(tension_N);
  }
  return text.empty() ? "" : text + ", needed " + newtons(needed_N);
}

std::string overpulled_cable(const LossView& arm) {
  if (!cable::does_without(arm.release)) return "";
  for (Index c = static_cast<Index>(arm.table.feed_count()); c < static_cast<Index>(arm.table.cable_count()); ++c) {
    const double tension_N = arm.outputs.tension_measured_N[c];
    if (tension_N <= max_recovery_N(arm.table)) continue;
    return arm.names.cable(c) + " is pulled with " + newtons(tension_N) + ", allowed while the arm goes back without " +
           arm.names.cable(static_cast<Index>(arm.release.cable)) + ": " + newtons(max_recovery_N(arm.table));
  }
  return "";
}

}  // namespace liana::server
