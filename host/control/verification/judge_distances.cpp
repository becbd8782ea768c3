#include "host/control/verification/judge_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host/model/clearance/clearance.hpp"

namespace liana::verification {

namespace {

constexpr double kRounded_m = 1e-6;

First at_scene(const config::SceneConfig& scene, const simulation::Nearest& nearest, const LinkName& link_name) {
  if (nearest.link < 0) return {};
  return {clearance::obstacle_name(scene, nearest.other) + " (" + link_name(nearest.link) + ")", nearest.time_s};
}

First at_itself(const simulation::Nearest& nearest, const LinkName& link_name) {
  return {link_name(nearest.other) + " (" + link_name(nearest.link) + ")", nearest.time_s};
}

// An arm that is too near already may go away; the way back out may need it to go along beside a body first.
bool leads_away(const simulation::Distances& distances, double travel_m, const TooNearTo& too_near, bool retracts) {
  const double start_m = distances.scene_at_start_m, least_m = distances.scene.distance_m;
  const double end_m = distances.scene_at_end_m, allowed_m = too_near.least_m(retracts);
  if (!too_near.stands()) return end_m >= start_m && least_m >= start_m - kGivenAway_m;
  // Nothing but a retract ends nearer from where a stop could touch.
  const double ends_m = retracts || start_m >= kStopBeyond_m ? allowed_m : start_m;
  if (start_m >= allowed_m) return end_m >= ends_m && least_m >= start_m - kGivenAway_m;
  if (!retracts && !too_near.may_be_led(start_m)) return false;
  return end_m >= start_m + kAwayShare * travel_m && least_m >= start_m - kCreptDip_m;
}

// An arm that touches a body goes into no other one, and out of all that it touches.
const simulation::BodyBeside* entered(const simulation::Distances& distances, double prediction_m) {
  for (const simulation::BodyBeside& body : distances.bodies) {
    if (body.nearest.distance_m < std::min(body.at_start_m, prediction_m) - kGivenAway_m) return &body;
  }
  return nullptr;
}

// An arm that touches itself, or all but does, may unfold, and no more than rounding the other way. One that stood so
// when it was enabled may stay as well. What a stop has folded further than it may stay goes apart all the same.
bool leads_apart(const simulation::Distances& distances, double travel_m, const TooNearTo& itself) {
  const double start_m = distances.self_at_start_m, end_m = distances.self_at_end_m;
  if (distances.self.distance_m < start_m - kGivenAway_m) return false;
  if (!itself.stands()) return end_m >= start_m - kRounded_m;
  const double least_m = itself.least_m(false);
  return end_m >= least_m || (start_m < least_m && end_m >= start_m + kAwayShare * travel_m);
}

}  // namespace

void TooNearTo::stand(double distance_m) {
  const double kept_m = distance_m - kGivenAway_m;
  farthest_m_ = stands_ ? std::max(distance_m, farthest_m_) : distance_m;
  min_m_ = stands_ ? std::max(min_m_, kept_m) : kept_m;
  back_m_ = stands_ ? std::max(back_m_, kept_m) : kept_m;
  if (was_refused_) back_m_ = std::max(std::min(back_m_, distance_m - kCreptDip_m), farthest_m_ - kMostCrept_m);
  if (was_disabled_) back_m_ = kept_m;
  stands_ = true;
  was_refused_ = was_disabled_ = false;
}

std::string in_millimetres(double distance_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", 1000.0 * distance_m);
  return text;
}

std::string plain_link_name(std::int32_t link) { return "link " + std::to_string(link + 1); }

void refuse(SimulationVerdict& verdict, Refusal code, const std::string& text, const First& first) {
  verdict.code = code;
  verdict.text = text;
  verdict.first = first;
}

// Before anything else: a contact is what a command is stopped for.
void judge_distances(const config::SceneConfig& scene, const simulation::Distances& distances,
                     const LinkName& link_name, double travel_m, TooNear& too_near, SimulationVerdict& verdict) {
  const config::SceneMargins& levels = scene.margins;
  const double least_m = distances.scene.distance_m, start_m = distances.scene_at_start_m;
  const double claimed_m = least_m - levels.prediction_m;
  const double refuse_m = too_near.retracts ? std::min(0.0, levels.refuse_m) : levels.refuse_m;
  const First first = at_scene(scene, distances.scene, link_name);
  verdict.margins.clearance_m =
      clearance::obstacle_count(scene) > 0 ? claimed_m - refuse_m : margins_unknown().clearance_m;
  verdict.slowly = claimed_m < levels.slow_m;
  verdict.first = first;
  const double left_m = too_near.scene.stands() ? kLeft_m : 0.0;
  const bool stands_too_near = start_m - levels.prediction_m < refuse_m + left_m;
  stands_too_near ? too_near.scene.stand(start_m) : too_near.scene.forget();
  const double off_itself_m = distances.self_at_start_m;
  off_itself_m > 0.0 ? too_near.itself.forget() : too_near.itself.stand(off_itself_m);
  const auto refuse_contact = [&](double simulated_m, double stands_m, const First& where) {
    too_near.scene.refused();
    refuse(verdict, Refusal::kSceneContact,
           "the arm could touch " + where.body + ": predicted " + in_millimetres(simulated_m) + ", uncertain by " +
               in_millimetres(levels.prediction_m) + ", allowed " + in_millimetres(refuse_m) +
               " for certain; it stands " + in_millimetres(stands_m) + " off",
           where);
  };
  if (!std::isfinite(least_m) ||
      (claimed_m < refuse_m && !leads_away(distances, travel_m, too_near.scene, too_near.retracts))) {
    refuse_contact(least_m, start_m, first);
  } else if (const simulation::BodyBeside* body = entered(distances, levels.prediction_m)) {
    refuse_contact(body->nearest.distance_m, body->at_start_m, at_scene(scene, body->nearest, link_name));
  } else if (!(distances.self.distance_m > 0.0)) {
    const First self = at_itself(distances.self, link_name);
    if (leads_apart(distances, travel_m, too_near.itself))
      verdict.touches_itself = self.body;
    else
      refuse(verdict, Refusal::kSelfContact,
             "the arm would touch itself: " + self.body + ": predicted " + in_millimetres(distances.self.distance_m) +
                 "; it stands " + in_millimetres(distances.self_at_start_m) + " off",
             self);
  }
}

}  // namespace liana::verification
