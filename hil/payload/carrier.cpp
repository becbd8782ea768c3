#include "hil/payload/carrier.hpp"

#include <algorithm>
#include <utility>

namespace liana::bench {

namespace {

constexpr double kJams_at = 0.5;    // of the way
constexpr double kStopsIn = 0.375;  // of the time that the whole way takes

// From 0 to 1 without a jump of rate, acceleration or jerk: of all that begins and ends so it leaves the soft joints
// that it is led through with little swing.
double smooth(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * x * x * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x)));
}

}  // namespace

void Carrier::ask(ToolCommand command) {
  if (defects_.silent) return;
  asked_ = std::move(command);
  way_.reset();
}

ToolStatus Carrier::say(std::string phase, std::string reason, double now_s) {
  last_ = {asked_->number, std::move(phase), std::move(reason), now_s};
  if (last_.phase != "acting") {
    asked_.reset();
    way_.reset();
  }
  return last_;
}

std::optional<ToolStatus> Carrier::begin(double now_s, const CarryObservation& sight) {
  if (sight.takes_s <= 0.0) return say("failed", "no arm carries this one from anywhere", now_s);
  if (share_ >= 1.0) return say("failed", "the arm that carries is locked at the site already", now_s);
  if (!sight.arm_rests) return say("failed", "the arm that is carried moves: bring it to rest first", now_s);
  way_ = Way{share_, 0.0, now_s, sight.has_torque, {}, ""};
  return say("acting", "", now_s);
}

// Its time runs slower and slower once it has to stop: a sudden stop would leave all that it carries swinging.
void Carrier::go_on(double now_s, double takes_s) {
  const double stopping_s = way_->stops_since_s ? now_s - *way_->stops_since_s : 0.0;
  const double pace = 1.0 - smooth(stopping_s / (kStopsIn * takes_s));
  way_->gone_s += pace * (now_s - way_->at_s);
  way_->at_s = now_s;
  share_ = way_->from + (1.0 - way_->from) * smooth(way_->gone_s / takes_s);
}

std::optional<ToolStatus> Carrier::act(double now_s, const CarryObservation& sight) {
  if (!asked_ || now_s < asked_->begin_s) return std::nullopt;
  if (!way_) return begin(now_s, sight);
  go_on(now_s, sight.takes_s);
  const bool jams = defects_.jams && share_ > kJams_at;
  const bool lost_torque = way_->had_torque && !sight.has_torque;
  if (!way_->stops_since_s && (jams || lost_torque || !sight.arm_rests)) {
    way_->stops_since_s = now_s;
    way_->why = jams          ? "the arm that carries has stopped on its way"
                : lost_torque ? "the arm that is carried lost its torque: it was stopped"
                              : "the arm that is carried moved: it was stopped";
  }
  if (way_->gone_s >= sight.takes_s) return say("done", "", now_s);
  if (way_->stops_since_s && now_s - *way_->stops_since_s >= kStopsIn * sight.takes_s)
    return say("failed", way_->why, now_s);
  return std::nullopt;
}

}  // namespace liana::bench
