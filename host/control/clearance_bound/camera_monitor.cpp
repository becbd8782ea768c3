#include "host/control/clearance_bound/camera_monitor.hpp"

#include <array>
#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana::clearance_bound {
namespace {

constexpr double kLateBy_s = 0.1;
constexpr double kMaxSurprise = 12.0;  // mean square in standard deviations; arms in motion show up to 6, worn ones 20
constexpr double kSame = 6.0;          // noises by which two pictures of the same may differ

using Sighting = std::optional<Pose> Picture::*;
constexpr std::array<Sighting, 2> kSightings{&Picture::slit_in_tip, &Picture::rod_in_tip};

// Seen in a mirror that exchanges the sides of axis `axis` (0..2) of the tip frame.
Picture mirrored(Picture picture, std::size_t axis) {
  for (const Sighting sighting : kSightings) {
    if (!(picture.*sighting)) continue;
    Pose& pose = *(picture.*sighting);
    pose.position_m[axis] = -pose.position_m[axis];
    for (std::size_t i = 0; i < 3; ++i)
      if (i != axis) pose.quaternion[i + 1] = -pose.quaternion[i + 1];
  }
  return picture;
}

bool is_same(const std::optional<Pose>& a, const std::optional<Pose>& b) {
  if (!a || !b) return !a && !b;
  return a->position_m == b->position_m && a->quaternion == b->quaternion;
}

bool is_copy(const Picture& a, const Picture& b) {
  return is_same(a.slit_in_tip, b.slit_in_tip) && is_same(a.rod_in_tip, b.rod_in_tip);
}

}  // namespace

const char* trouble_name(CameraStatus trouble) {
  static constexpr std::array<const char*, 7> kNames{"none",   "no picture", "time stamp", "late",
                                                     "frozen", "mirrored",   "jumped"};
  return kNames[static_cast<std::size_t>(trouble)];
}

CameraStatus CameraMonitor::judge_time(const Picture& picture, std::uint64_t tick) {
  if (picture.tick > tick || (newest_ && picture.tick <= *newest_)) return CameraStatus::kTimeStamp;
  newest_ = picture.tick;
  const double age_s = static_cast<double>(tick - picture.tick) * tick_s_;
  return age_s > camera_.latency_s + kLateBy_s ? CameraStatus::kLate : CameraStatus::kNone;
}

bool CameraMonitor::is_believable(const Picture& picture, const MeasuredArm& measured) const {
  return known_->surprise(picture, measured) <= kMaxSurprise;
}

// Shows the same as the last one that was believed, within the noise.
bool CameraMonitor::repeats(const Picture& picture) const {
  if (!believed_) return false;
  for (const Sighting sighting : kSightings) {
    const std::optional<Pose>&now = picture.*sighting, &before = (*believed_).*sighting;
    if (now.has_value() != before.has_value()) return false;
    if (!now) continue;
    const Quat turn = multiply(conjugate(before->quaternion), now->quaternion);
    if (norm(subtract(now->position_m, before->position_m)) >= kSame * camera_.noise_m) return false;
    if (norm(rotation_vector(normalize(turn))) >= kSame * camera_.noise_deg * kDegree) return false;
  }
  return true;
}

CameraStatus CameraMonitor::judge_view(const Picture& picture, const MeasuredArm& measured,
                                       const Registration& registration) {
  if (!known_) known_ = registration;
  if (camera_.noise_m > 0.0 && believed_ && is_copy(picture, *believed_))
    return CameraStatus::kFrozen;  // no two are alike to the bit
  if (is_believable(picture, measured)) {
    known_.reset();
    believed_ = picture;
    return CameraStatus::kNone;
  }
  if (repeats(picture)) return CameraStatus::kFrozen;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (is_believable(mirrored(picture, axis), measured)) return CameraStatus::kMirrored;
  return CameraStatus::kJumped;
}

}  // namespace liana::clearance_bound
