// What a push loads the arm with, by the bench's truth: six axes at its end and at its base, and what it overcame
// (requirement B25; docs/reference/command-line.md, "A payload's installation").
#pragma once

#include "host/apps/report/truth_figures.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::report {

constexpr const char* kPushLoads[] = {"resisted_N",    "margin_N",     "end_force_N",
                                      "end_torque_Nm", "base_force_N", "base_torque_Nm"};

// Adds the largest amount of each axis over these rows: at the arm's end in its frame, what the payload gives it, its
// inertia included; at the arm's base in the base frame, what that asks of the base. The arm's own inertia is not in
// it: it moves at some mm/s.
void add_wrenches(Json& report, const TruthLog& truth, const Rows& rows);

// Adds what the payload had to overcome along its way in in the row of the capture, and what of the force that was set
// was left.
void add_margin(Json& report, const TruthLog& truth, std::size_t captured_row, double set_N);

}  // namespace liana::report
