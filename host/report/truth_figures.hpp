// What the truth says of a run: its figures for the report, and whether the run kept what a success has to keep.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware_like/math/pose.hpp"
#include "host/json/json_fwd.hpp"
#include "host/report/truth.hpp"

namespace liana::report {

// Rows of the truth, both included, that figures are taken over.
struct Rows {
  std::size_t first = 0;
  std::size_t last = 0;
};

// What a success has to keep besides its mission's own goal; what is not set is not asked for.
struct Criteria {
  std::optional<double> least_motor_tension_N;
  std::optional<double> least_tension_N;      // anywhere along a cable
  std::optional<double> most_slit_speed_m_s;  // of the true tip, inside the slit
};

// The criteria of a robot's table (its JSON) under this physics: none for a serial arm, and the motor's only where
// cables are as they were planned with (nominal, ideal).
Criteria criteria_of(const Json& robot, const std::string& physics);

// Adds every figure that the truth has; `rod` and `commanded_tip` at the last row: their errors, where they are given.
void add_figures(Json& report, const TruthLog& truth, const Rows& rows, const std::optional<Pose>& rod,
                 const std::optional<Pose>& commanded_tip);

// Adds `criteria` (name, value, limit, met) for what the report has figures of; the first that is not met in words,
// empty when all are.
std::string judge(Json& report, const Criteria& criteria);

// Adds `after_failure_s`, how long the arm still moved after the row `failed` (any angle faster than 0.1 deg/s), and
// `ends_at_rest`, whether it stands in the last row.
void add_aftermath(Json& report, const TruthLog& truth, std::size_t failed, double period_s);

}  // namespace liana::report
