#include "host/control/virtual_fixtures/guidance.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/model/inverse_kinematics/dof_split.hpp"

namespace liana::virtual_fixtures {
namespace {

using Index = std::size_t;

constexpr double kSight_s = 2.0;         // low pass: the tip swings at 0.6 Hz about where it is led
constexpr double kSight_m_s = 0.005;     // and no faster than this: the first picture moves the scene by millimetres
constexpr double kSight_rad_s = 0.0035;  // 0.2 deg/s
constexpr double kMaxOff_m = 0.03;       // more than an arm that is well is off its command: no more is made up for
constexpr double kMaxOff_rad = 0.035;    // 2 deg
constexpr double kLeave_m = 0.02;        // a plane that guides does so until the tip is out of its box by this
constexpr std::int32_t kHalvings = 6;    // of the way between two yaws: a 64th of it is nothing a hand feels

Vec3 no_longer(const Vec3& v, double most) {
  const double length = norm(v);
  return length > most ? scale(v, most / length) : v;
}

// On the way from `from` to `to` for dt_s.
Vec3 followed(const Vec3& from, const Vec3& to, double speed, double dt_s) {
  return add(from, no_longer(scale(subtract(to, from), std::min(1.0, dt_s / kSight_s)), speed * dt_s));
}

Pose followed(const Pose& from, const Pose& to, double dt_s) {
  const Vec3 turn =
      followed({}, rotation_vector(multiply(to.quaternion, conjugate(from.quaternion))), kSight_rad_s, dt_s);
  return {followed(from.position_m, to.position_m, kSight_m_s, dt_s),
          normalize(multiply(quaternion_of(turn), from.quaternion))};
}

}  // namespace

std::int32_t planar_of_mask(const RobotParams& table, std::uint32_t held_mask) {
  std::int32_t segments = 0;
  while (segments < table.segment_count && (held_mask >> (2 * (table.segment_count - 1 - segments)) & 1u) != 0)
    ++segments;
  return segments;
}

Guidance::Guidance(const RobotParams& table, const std::vector<config::SceneFixture>& fixtures, double arm_radius_m)
    : table_(table), fixtures_(fixtures), arm_radius_m_(arm_radius_m) {}

bool Guidance::knows(const std::string& name) const {
  return std::any_of(fixtures_.begin(), fixtures_.end(), [&](const auto& fixture) { return fixture.name == name; });
}

bool Guidance::is_chosen(const std::string& name) const {
  return !choice_ || std::find(choice_->begin(), choice_->end(), name) != choice_->end();
}

// What is seen first is taken as it is: nobody has been guided by anything else.
void Guidance::see(const Sight& sight, double dt_s) {
  const Sight now{sight.drawing_in_base, no_longer(sight.off_m, kMaxOff_m), no_longer(sight.off_rad, kMaxOff_rad)};
  if (!has_seen_) sight_ = now;
  has_seen_ = true;
  sight_.off_m = followed(sight_.off_m, now.off_m, kSight_m_s, dt_s);
  sight_.off_rad = followed(sight_.off_rad, now.off_rad, kSight_rad_s, dt_s);
  sight_.drawing_in_base = followed(sight_.drawing_in_base, now.drawing_in_base, dt_s);
}

bool Guidance::acts(std::size_t index, const Commanded& now) const {
  const config::SceneFixture& fixture = fixtures_[index];
  if (fixture.kind != config::FixtureKind::kPlane || !is_chosen(fixture.name)) return false;
  if (planar_of_mask(table_, now.held_mask) == 0) return false;
  const Vec3 tip =
      in_frame(frame_in_base(fixture, sight_.drawing_in_base), add(now.tip_in_base.position_m, sight_.off_m));
  const double more_m = active_ == index ? kLeave_m : 0.0;
  return is_along(fixture, tip, more_m) && std::fabs(tip[1]) <= fixture.half_gap_m + more_m;
}

// The first of the scene's that acts.
void Guidance::find_plane(const Commanded& now) {
  std::optional<Index> found;
  for (Index i = 0; i < fixtures_.size() && !found; ++i) {
    if (acts(i, now)) found = i;
  }
  active_ = found;
  plane_ = found ? std::optional(placed(fixtures_[*found], now)) : std::nullopt;
}

// On which side of it the tip's y is: where it stands, however far a hand has turned.
GuidePlane Guidance::placed(const config::SceneFixture& fixture, const Commanded& now) const {
  const Pose seen = frame_in_base(fixture, sight_.drawing_in_base);
  const Quat back = quaternion_of(scale(sight_.off_rad, -1.0));
  constexpr Vec3 kY{0.0, 1.0, 0.0};
  const bool is_along = dot(rotate(seen.quaternion, kY), rotate(now.tip_in_base.quaternion, kY)) >= 0.0;
  return {{subtract(seen.position_m, sight_.off_m), seen.quaternion},
          multiply(back, seen.quaternion),
          fixture.yaw_low_deg * kDegree,
          fixture.yaw_high_deg * kDegree,
          is_along ? 1.0 : -1.0};
}

// The yaws that leave the planar part a way through the mouth and its root within reach (requirement A39), on the way
// from where the tip stands to where the hand turns it. An arm that does not fit as it stands is not held back.
void Guidance::limit_yaw(const Pose& goal, const Commanded& now) {
  const config::SceneFixture& slit = fixtures_[*active_];
  const inverse_kinematics::SlitMouth mouth{plane_->frame_in_base, slit.depth_m, slit.half_gap_m - arm_radius_m_,
                                            slit.half_width_m};
  const double from = yaw_rad(*plane_, now.tip_in_base.quaternion), to = yaw_rad(*plane_, goal.quaternion);
  inverse_kinematics::PlanarPart part{planar_of_mask(table_, now.held_mask), in_plane(*plane_, goal), now.theta_rad};
  const auto fits_at = [&](double share) {
    GuidePlane only = *plane_;
    only.yaw_low_rad = only.yaw_high_rad = from + share * (to - from);
    part.tip_in_base = in_plane(only, goal);
    return inverse_kinematics::some_yaw_fits(table_, part, mouth);
  };
  yaw_limited_ = !fits_at(1.0) && fits_at(0.0);
  if (!yaw_limited_) return;
  double fitting = 0.0, beyond = 1.0;
  for (std::int32_t i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (fitting + beyond);
    (fits_at(middle) ? fitting : beyond) = middle;
  }
  const double most = from + fitting * (to - from);
  if (to > from) plane_->yaw_high_rad = std::max(plane_->yaw_low_rad, most);
  if (to < from) plane_->yaw_low_rad = std::min(plane_->yaw_high_rad, most);
}

Pose Guidance::guide(const Pose& goal, const Commanded& now, double dt_s) {
  find_plane(now);
  yaw_limited_ = false;
  taken_away_m_ = plane_ ? off_plane_m(*plane_, goal.position_m) : 0.0;
  if (plane_) limit_yaw(goal, now);
  return guide_.next(goal, plane_, dt_s);
}

void Guidance::stop() {
  guide_.stop();
  plane_.reset();
  active_.reset();
  taken_away_m_ = 0.0;
  yaw_limited_ = false;
}

const std::string& Guidance::plane_name() const {
  static const std::string kNone;
  return active_ ? fixtures_[*active_].name : kNone;
}

}  // namespace liana::virtual_fixtures
