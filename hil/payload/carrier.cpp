#include "hil/payload/carrier.hpp"

#include <algorithm>
#include <utility>

namespace liana::bench {

namespace {

constexpr double kJams_at = 0.5;  // of the way

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
  acting_ = false;
}

ToolReport Carrier::say(std::string phase, std::string reason, double now_s) {
  last_ = {asked_->number, std::move(phase), std::move(reason), now_s};
  if (last_.phase != "acting") asked_.reset();
  return last_;
}

std::optional<ToolReport> Carrier::act(double now_s, const CarrySight& sight) {
  if (!asked_ || now_s < asked_->begin_s) return std::nullopt;
  if (!sight.arm_rests) return say("failed", "the arm that is carried moves: bring it to rest first", now_s);
  if (!acting_) {
    if (sight.takes_s <= 0.0) return say("failed", "no arm carries this one from anywhere", now_s);
    if (share_ >= 1.0) return say("failed", "the arm that carries is locked at the site already", now_s);
    acting_ = true;
    begun_at_ = share_;
    return say("acting", "", now_s);
  }
  const double gone = smooth((now_s - asked_->begin_s) / sight.takes_s);
  share_ = begun_at_ + (1.0 - begun_at_) * gone;
  if (defects_.jams && share_ > kJams_at) return say("failed", "the arm that carries has stopped on its way", now_s);
  if (gone < 1.0) return std::nullopt;
  return say("done", "", now_s);
}

}  // namespace liana::bench
