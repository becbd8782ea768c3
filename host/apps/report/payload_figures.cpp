#include "host/apps/report/payload_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/apps/report/push_loads.hpp"
#include "host/apps/report/truth_figures.hpp"
#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

constexpr std::array kFigures{"servo_error_m", "servo_error_deg", "settling_s",      "lateral_sway_m",
                              "force_rise_s",  "force_N",         "load_duration_s", "peak_joint_torque_Nm",
                              "peak_force_N",  "insertion_m",     "unload_s",        "base_deflection_m"};

Rows rows_of(const TruthLog& truth, const Span& span) {
  return {truth.row_of_slot(span.begin_tick), truth.row_of_slot(span.end_tick)};
}

std::size_t rows_in(double time_s, double period_s) {
  return static_cast<std::size_t>(std::max(1L, std::lround(time_s / period_s)));
}

// ---- servo ------------------------------------------------------------------------------------------------------

// The middle of the pins' tips from where the servo brings it, in the adapter's frame.
Vec3 beside_m(const TruthLog& truth, std::size_t row, const Vec3& wanted_m) {
  return subtract({truth.at(row, "plate_x_m"), truth.at(row, "plate_y_m"), truth.at(row, "plate_z_m")}, wanted_m);
}

bool is_settled(const TruthLog& truth, std::size_t row, const Vec3& wanted_m) {
  return norm(beside_m(truth, row, wanted_m)) <= kSettled_m && truth.at(row, "plate_tilt_deg") <= kSettled_deg;
}

// How far x or y comes away again from where it has been nearest.
double sway_m(const TruthLog& truth, const Rows& rows, const Vec3& wanted_m) {
  std::array<double, 2> nearest_m{1e9, 1e9};
  double sway = 0.0;
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    const Vec3 beside = beside_m(truth, row, wanted_m);
    for (std::size_t i = 0; i < nearest_m.size(); ++i) {
      nearest_m[i] = std::fmin(nearest_m[i], std::fabs(beside[i]));
      sway = std::fmax(sway, std::fabs(beside[i]) - nearest_m[i]);
    }
  }
  return sway;
}

void add_servo(Json& report, const PayloadSources& from) {
  const std::vector<Span> servos = servos_of(from.stages);
  const auto last = std::find_if(servos.rbegin(), servos.rend(), [](const Span& servo) {
    return servo.target == "adapter" && servo.end == "done" && servo.place;
  });
  if (last == servos.rend()) return;
  const Rows rows = rows_of(from.truth, *last);
  const Vec3& wanted_m = last->place->position_m;
  report["servo_error_m"] = norm(beside_m(from.truth, rows.last, wanted_m));
  report["servo_error_deg"] = from.truth.at(rows.last, "plate_tilt_deg");
  report["lateral_sway_m"] = sway_m(from.truth, rows, wanted_m);
  std::size_t settled = rows.last + 1;
  while (settled > rows.first && is_settled(from.truth, settled - 1, wanted_m)) --settled;
  if (settled <= rows.last) report["settling_s"] = static_cast<double>(settled - rows.first) * from.period_s;
}

// ---- force ------------------------------------------------------------------------------------------------------

// What the payload gives the adapter along the way in.
double pushed_N(const TruthLog& truth, std::size_t row) { return -truth.at(row, "contact_z_N"); }

double contact_N(const TruthLog& truth, std::size_t row) {
  return norm(Vec3{truth.at(row, "contact_x_N"), truth.at(row, "contact_y_N"), truth.at(row, "contact_z_N")});
}

double depth_m(const TruthLog& truth, std::size_t row) {
  return (truth.at(row, "depth_m_1") + truth.at(row, "depth_m_2") + truth.at(row, "depth_m_3")) / 3.0;
}

// First row of a range in which `holds`; the row behind it where there is none.
template <class Holds>
std::size_t first_row(const Rows& rows, const Holds& holds) {
  std::size_t row = rows.first;
  while (row <= rows.last && !holds(row)) ++row;
  return row;
}

// The row from which on the contact is gone, before the lock drive moves the pins; the row behind all where it never
// is.
std::size_t unloaded_row(const PayloadSources& from, std::size_t captured) {
  const std::size_t rows = from.truth.row_count(), needed = rows_in(kUnloaded_s, from.period_s);
  std::size_t light = 0;
  for (std::size_t row = captured; row < rows && from.truth.at(row, "lock") == 0.0; ++row) {
    light = contact_N(from.truth, row) < kUnloaded_N ? light + 1 : 0;
    if (light == needed) return row + 1 - needed;
  }
  return rows;
}

// Means of the force along the way in, one for each row from `needed` rows after the first.
void add_force(Json& report, const PayloadSources& from, const Rows& rows) {
  const std::size_t width = rows_in(kForceMean_s, from.period_s);
  std::vector<double> mean_N;
  double sum = 0.0;
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    sum += pushed_N(from.truth, row);
    if (row >= rows.first + width) sum -= pushed_N(from.truth, row - width);
    mean_N.push_back(sum / static_cast<double>(width));
  }
  const double most_N = *std::max_element(mean_N.begin(), mean_N.end());
  if (most_N <= 0.0) return;  // nothing was touched
  const auto risen = std::find_if(mean_N.begin(), mean_N.end(), [&](double f) { return f >= kRisen * most_N; });
  report["force_N"] = most_N;
  report["force_rise_s"] = static_cast<double>(risen - mean_N.begin()) * from.period_s;
}

double most_torque_Nm(const TruthLog& truth, const Rows& rows) {
  double most = 0.0;
  for (int joint = 1; truth.has("torque_Nm_" + std::to_string(joint)); ++joint) {
    const std::string column = "torque_Nm_" + std::to_string(joint);
    most = std::fmax(
        most, std::fmax(truth.largest(column, rows.first, rows.last), -truth.smallest(column, rows.first, rows.last)));
  }
  return most;
}

double deepest_m(const TruthLog& truth, const Rows& rows) {
  double deepest = 0.0;
  for (std::size_t row = rows.first; row <= rows.last; ++row) deepest = std::fmax(deepest, depth_m(truth, row));
  return deepest;
}

// The most that was set in a push.
double set_N(const std::vector<Stage>& stages, const Span& push) {
  double most = 0.0;
  for (const Stage& stage : stages)
    if (stage.tick >= push.begin_tick && stage.tick <= push.end_tick) most = std::fmax(most, stage.set_N);
  return most;
}

void add_push(Json& report, const PayloadSources& from) {
  const std::vector<Span> pushes = pushes_of(from.stages);
  if (pushes.empty()) return;
  const TruthLog& truth = from.truth;
  const Rows rows = rows_of(truth, pushes.back());
  const std::size_t captured = first_row(rows, [&](std::size_t row) { return truth.at(row, "captured") > 0.0; });
  const std::size_t unloaded = captured <= rows.last ? unloaded_row(from, captured) : truth.row_count();
  const bool is_unloaded = unloaded < truth.row_count();
  const Rows pressing{rows.first, std::min(captured, rows.last)};
  const Rows loaded{rows.first, is_unloaded ? unloaded : rows.last};
  add_force(report, from, pressing);
  report["insertion_m"] = deepest_m(truth, pressing);
  report["peak_force_N"] = truth.largest("contact_peak_N", loaded.first, loaded.last);
  report["peak_joint_torque_Nm"] = most_torque_Nm(truth, loaded);
  report["base_deflection_m"] = truth.largest("base_deflection_m", loaded.first, loaded.last);
  add_wrenches(report, truth, loaded);
  if (captured <= rows.last) add_margin(report, truth, captured, set_N(from.stages, pushes.back()));
  if (!is_unloaded) return;
  const std::size_t touched = first_row(loaded, [&](std::size_t row) { return truth.at(row, "contact_peak_N") > 0.0; });
  report["unload_s"] = static_cast<double>(unloaded - captured) * from.period_s;
  report["load_duration_s"] = static_cast<double>(unloaded - std::min(touched, unloaded)) * from.period_s;
}

}  // namespace

bool has_payload(const TruthLog& truth) { return truth.has("plate_x_m"); }

void add_payload_figures(Json& report, const PayloadSources& sources) {
  for (const char* figure : kFigures) report[figure] = nullptr;
  for (const char* figure : kPushLoads) report[figure] = nullptr;
  if (sources.truth.row_count() == 0 || sources.period_s <= 0.0) return;
  add_servo(report, sources);
  add_push(report, sources);
}

}  // namespace liana::report
