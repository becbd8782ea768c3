#include "host/apps/report/truth_figures.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

constexpr double kRest_deg_s = 0.1;
constexpr double kSlitSwing = 1.05;  // times the table's limit: the true tip swings about the commanded speed

double distance_m(const Pose& a, const Pose& b) { return norm(subtract(a.position_m, b.position_m)); }

double angle_rad(const Pose& a, const Pose& b) {
  return norm(rotation_vector(multiply(conjugate(a.quaternion), b.quaternion)));
}

void add_speeds(Json& report, const TruthLog& truth, const Rows& rows) {
  double slit_m_s = 0.0;
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    if (truth.at(row, "slit_depth_m") > 0.0) slit_m_s = std::fmax(slit_m_s, truth.at(row, "tip_speed_m_s"));
  }
  report["max_tip_speed_m_s"] = truth.largest("tip_speed_m_s", rows.first, rows.last);
  report["max_tip_speed_slit_m_s"] = slit_m_s;
}

// Of what the scene has.
void add_clearance(Json& report, const char* key, double clearance_m) {
  constexpr double kNothing_m = 999.0;  // the bench says 1000 where there is nothing
  if (clearance_m < kNothing_m) report[key] = clearance_m;
}

void add_cable_figures(Json& report, const TruthLog& truth, const Rows& rows, bool has_slit) {
  const auto [first, last] = rows;
  report["final_theta_deg"] = truth.angles_deg("theta_deg_", last);
  add_clearance(report, "min_clearance_m", truth.smallest("clearance_m", first, last));
  add_clearance(report, has_slit ? "min_slit_clearance_m" : "min_box_clearance_m",
                truth.smallest("slit_clearance_m", first, last));
  add_clearance(report, "min_sphere_clearance_m", truth.smallest("sphere_clearance_m", first, last));
  report["max_contact_force_N"] = report["peak_force_N"] = truth.largest("contact_force_N", first, last);
  report["rod_force_N"] = truth.at(last, "rod_force_N");
  report["cable_tension_N"] = {{"min", truth.smallest("tension_min_N", first, last)},
                               {"min_motor", truth.smallest("tension_motor_min_N", first, last)},
                               {"max", truth.largest("tension_motor_max_N", first, last)}};
  if (truth.has("tip_speed_m_s")) add_speeds(report, truth, rows);
}

void add_serial_figures(Json& report, const TruthLog& truth, const Rows& rows) {
  double largest_Nm = 0.0;
  for (int joint = 1; truth.has("torque_Nm_" + std::to_string(joint)); ++joint) {
    const std::string column = "torque_Nm_" + std::to_string(joint);
    largest_Nm = std::fmax(largest_Nm, std::fmax(truth.largest(column, rows.first, rows.last),
                                                 -truth.smallest(column, rows.first, rows.last)));
  }
  report["final_joint_deg"] = truth.angles_deg("joint_deg_", rows.last);
  report["max_joint_torque_Nm"] = largest_Nm;
  if (truth.has("clearance_m"))
    add_clearance(report, "min_clearance_m", truth.smallest("clearance_m", rows.first, rows.last));
}

// Of a serial arm, since the row before.
double fastest_joint_deg_s(const TruthLog& truth, std::size_t row, double period_s) {
  const std::vector<double> now = truth.angles_deg("joint_deg_", row), before = truth.angles_deg("joint_deg_", row - 1);
  double fastest = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) fastest = std::fmax(fastest, std::fabs(now[i] - before[i]) / period_s);
  return fastest;
}

std::string in_words(const char* what, const char* relation, double value, double limit, const char* unit) {
  char text[160];
  std::snprintf(text, sizeof text, "%s was %.4g %s, %s %.4g", what, value, unit, relation, limit);
  return text;
}

}  // namespace

Criteria criteria_of(const Json& robot, const std::string& physics) {
  Criteria criteria;
  if (!robot.contains("tension")) {
    criteria.required_clearance_m = 0.0;
    return criteria;
  }
  if (physics != "worn") criteria.min_motor_tension_N = robot["tension"]["floor_motor_N"].get<double>();
  criteria.least_tension_N = robot["tension"]["floor_anywhere_N"].get<double>();
  criteria.max_slit_speed_m_s = kSlitSwing * robot["limits"]["tip_speed_slit_m_s"].get<double>();
  return criteria;
}

void add_figures(Json& report, const TruthLog& truth, const Rows& rows, const std::optional<Pose>& rod,
                 const std::optional<Pose>& commanded_tip, bool has_slit) {
  const Pose tip = truth.tip(rows.last);
  const bool serial = truth.has("joint_deg_1");
  if (rod && !serial) {  // no serial arm presses a rod yet
    report["tip_error_m"] = distance_m(tip, *rod);
    report["tip_attitude_error_rad"] = angle_rad(tip, *rod);
  }
  if (commanded_tip) report["open_loop_tip_error_m"] = distance_m(tip, *commanded_tip);
  if (serial) {
    add_serial_figures(report, truth, rows);
  } else {
    add_cable_figures(report, truth, rows, has_slit);
  }
}

void add_nearest(Json& report, const TruthLog& truth, const Rows& rows, const BodyAt& body_at) {
  if (!report.contains("min_clearance_m")) return;
  std::size_t nearest = rows.first;
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    if (truth.at(row, "clearance_m") < truth.at(nearest, "clearance_m")) nearest = row;
  }
  report["nearest"] = body_at(truth.angles_deg("theta_deg_", nearest));
  report["nearest"]["clearance_m"] = report["min_clearance_m"];
}

Json contact_in(const TruthLog& truth, const Rows& rows, const BodyAt& body_at, std::uint64_t begin_slot,
                double period_s) {
  std::size_t first = rows.last, hardest = rows.first;
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    const double force_N = truth.at(row, "contact_force_N");
    if (force_N > 0.0) first = std::min(first, row);
    if (force_N > truth.at(hardest, "contact_force_N")) hardest = row;
  }
  Json contact = body_at(truth.angles_deg("theta_deg_", hardest));
  contact["force_N"] = truth.at(hardest, "contact_force_N");
  contact["first_s"] = (truth.at(first, "slot") - static_cast<double>(begin_slot)) * period_s;
  return contact;
}

int contact_count(const TruthLog& truth, const Rows& rows, double period_s) {
  constexpr double kApart_s = 0.1;
  int contacts = 0;
  double touched_s = -1e9;
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    if (truth.at(row, "contact_force_N") <= 0.0) continue;
    const double now_s = truth.at(row, "slot") * period_s;
    contacts += now_s - touched_s > kApart_s ? 1 : 0;
    touched_s = now_s;
  }
  return contacts;
}

std::string judge(Json& report, const Criteria& criteria) {
  std::string first;
  const auto hold = [&](const char* name, const char* what, const char* unit, const Json& value, double limit,
                        bool least) {
    const bool met = least ? value.get<double>() >= limit : value.get<double>() <= limit;
    report["criteria"].push_back({{"name", name}, {"value", value}, {"limit", limit}, {"met", met}});
    if (!met && first.empty())
      first = in_words(what, least ? "below" : "above", value.get<double>(), limit, unit) + " (" + name + ")";
  };
  report["criteria"] = Json::array();
  if (report.contains("truly_captured"))
    hold("truly_captured", "the pins were told to be captured and truly captured", "(0: no, 1: yes)",
         report["truly_captured"].get<bool>() ? 1.0 : 0.0, 1.0, true);
  if (criteria.min_motor_tension_N && report.contains("cable_tension_N"))
    hold("tension_at_motor", "the least tension at a motor", "N", report["cable_tension_N"]["min_motor"],
         *criteria.min_motor_tension_N, true);
  if (criteria.least_tension_N && report.contains("cable_tension_N"))
    hold("tension_anywhere", "the least tension of a cable", "N", report["cable_tension_N"]["min"],
         *criteria.least_tension_N, true);
  if (criteria.max_slit_speed_m_s && report.contains("max_tip_speed_slit_m_s"))
    hold("tip_speed_in_slit", "the true tip's speed in the slit", "m/s", report["max_tip_speed_slit_m_s"],
         *criteria.max_slit_speed_m_s, false);
  if (criteria.required_clearance_m && report.contains("min_clearance_m"))
    hold("touches_nothing", "the least true distance to a body of the scene", "m", report["min_clearance_m"],
         *criteria.required_clearance_m, true);
  return first;
}

void add_aftermath(Json& report, const TruthLog& truth, std::size_t failed, double period_s) {
  const bool is_told = truth.has("fastest_deg_s");
  if (!is_told && (!truth.has("joint_deg_1") || period_s <= 0.0)) return;
  std::size_t moved = failed;
  for (std::size_t row = std::max<std::size_t>(failed, 1); row < truth.row_count(); ++row) {
    const double fastest_deg_s = is_told ? truth.at(row, "fastest_deg_s") : fastest_joint_deg_s(truth, row, period_s);
    if (fastest_deg_s > kRest_deg_s) moved = row;
  }
  report["after_failure_s"] = static_cast<double>(moved - failed) * period_s;
  report["ends_at_rest"] = moved + 1 < truth.row_count();
}

}  // namespace liana::report
