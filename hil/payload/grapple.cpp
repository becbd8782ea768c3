#include "hil/payload/grapple.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace liana::bench {

void Grapple::ask(ToolCommand command) {
  if (defects_.silent) return;
  asked_ = std::move(command);
  name_ = asked_->command;
  acting_ = false;
}

ToolStatus Grapple::say(std::string phase, std::string reason, double now_s) {
  last_ = {asked_->number, std::move(phase), std::move(reason), now_s};
  if (last_.phase != "acting") asked_.reset();
  return last_;
}

std::optional<std::string> Grapple::why_it_fails(const GrappleObservation& sight) const {
  if (name_ == "release") {
    if (!sight.has_payload) return "there is no payload to release";
    if (!sight.locked) return "the payload is not locked in the adapter and would drift away";
    return std::nullopt;
  }
  if (name_ != "grapple")
    return "the end effector knows grapple and release, the arm that carries knows carry, not " + name_;
  if (sight.has_payload) return "the payload is on the arm already";
  const double apart_m = norm(sight.grapple_in_tip.position_m), tilt_rad = angle_of(sight.grapple_in_tip.attitude);
  if (apart_m <= kReach_m && tilt_rad <= kTilt_rad) return std::nullopt;
  char text[100];
  std::snprintf(text, sizeof text, "the grapple is %.0f mm and %.1f deg from the tip, at most 20 mm and 2 deg close",
                std::min(1e3 * apart_m, 99999.0), 57.29577951308232 * tilt_rad);
  return text;
}

std::optional<ToolStatus> Grapple::act(double now_s, const GrappleObservation& sight) {
  if (!asked_ || now_s < asked_->begin_s) return std::nullopt;
  if (const auto why = why_it_fails(sight)) return say("failed", *why, now_s);
  if (!acting_) {
    acting_ = true;
    return say("acting", "", now_s);
  }
  const double acted_s = now_s - asked_->begin_s;
  if (defects_.jams && acted_s > 0.5 * kActing_s) return say("failed", "the end effector is jammed", now_s);
  if (acted_s < kActing_s) return std::nullopt;
  return say("done", "", now_s);
}

}  // namespace liana::bench
