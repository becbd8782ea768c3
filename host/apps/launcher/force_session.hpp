// One configuration of `liana force --self-test`: a simulated arm is moved, pushed by its bench, and asked what it
// feels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/apps/launcher/lockstep_session.hpp"
#include "host/apps/report/force_readings.hpp"
#include "host/model/config/config.hpp"

namespace liana::launcher {

// One push, at rest and then on a move.
struct PlannedPush {
  std::int32_t link = 0;  // 1 at the base; 0: the tip
  Vec3 force_N{};
  std::vector<double> rest_deg, move_deg;  // where the arm goes before it, and while it lasts
};

struct ForcePlan {
  std::size_t number = 0;  // of the configuration
  std::string start_pose;
  std::vector<PlannedPush> pushes;  // the last one may be on the body
};

// Configuration `number` of a self-test: `pushes` drawn from `seed`, between the straight arm and a named pose. The
// last one is on the body, or has 5 N, in turn.
ForcePlan force_plan(const config::RobotConfig& robot, std::size_t number, std::size_t pushes, std::uint64_t seed);

// The bench's fault list (docs/how-to/run-hil.md) with the pushes of a plan.
std::string push_list(const ForcePlan& plan, double tick_s);

// Runs it and adds to `all`; a fault ends it early. Throws as LockstepSession does.
void feel_forces(LockstepSession& session, const ForcePlan& plan, const config::RobotConfig& robot,
                 report::ForceReadings& all);

}  // namespace liana::launcher
