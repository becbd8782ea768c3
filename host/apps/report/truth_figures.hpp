// What the truth says of a run: its figures for the report, and whether the run kept what a success has to keep.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/apps/report/truth.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::report {

// Rows of the truth, both included, that figures are taken over.
struct Rows {
  std::size_t first = 0;
  std::size_t last = 0;
};

// What a success has to keep besides its mission's own goal; what is not set is not asked for.
struct Criteria {
  std::optional<double> min_motor_tension_N;
  std::optional<double> least_tension_N;       // anywhere along a cable
  std::optional<double> max_slit_speed_m_s;    // of the true tip, inside the slit
  std::optional<double> required_clearance_m;  // true, to any body of the scene
};

// The criteria of a robot's table (its JSON) under this physics: a serial arm touches nothing; the motor's only where
// cables are as they were planned with (nominal, ideal).
Criteria criteria_of(const Json& robot, const std::string& physics);

// Adds every figure that the truth has; `rod` and `commanded_tip` at the last row: their errors, where they are given.
// Clearances are of what the scene has; its boxes are a slit's when it `has_slit`.
void add_figures(Json& report, const TruthLog& truth, const Rows& rows, const std::optional<Pose>& rod,
                 const std::optional<Pose>& commanded_tip, bool has_slit);

// Which body of the scene the arm at these angles [deg] is nearest to, or in: {"body","link"}.
using BodyAt = std::function<Json(const std::vector<double>& theta_deg)>;

// Adds `nearest`: {"body","link","clearance_m"} of the row in which the arm was nearest to any body of the scene;
// nothing where it has none.
void add_nearest(Json& report, const TruthLog& truth, const Rows& rows, const BodyAt& body_at);

// The hardest contact of the arm with a body in these rows, of which one has a contact: {"body","link","force_N",
// "first_s"}; `first_s`: when it was first touched, after `begin_slot`.
Json contact_in(const TruthLog& truth, const Rows& rows, const BodyAt& body_at, std::uint64_t begin_slot,
                double period_s);

// How often the arm touched a body in these rows of a cable arm's truth; less than a tenth of a second apart is one
// touch.
int contact_count(const TruthLog& truth, const Rows& rows, double period_s);

// Adds `criteria` (name, value, limit, met) for what the report has figures of; the first that is not met in words,
// empty when all are.
std::string judge(Json& report, const Criteria& criteria);

// Adds `after_failure_s`, how long the arm still moved after the row `failed` (any angle faster than 0.1 deg/s), and
// `ends_at_rest`, whether it stands in the last row.
void add_aftermath(Json& report, const TruthLog& truth, std::size_t failed, double period_s);

}  // namespace liana::report
