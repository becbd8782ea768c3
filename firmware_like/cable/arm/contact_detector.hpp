// What touches the arm: the force at its tip with how sure that is, and where something else touches the body.
//
// The torques that nothing explains (torque_balance.hpp) are measured in their own deviations; least squares makes the
// force at the tip of them, up to 3 N of which is what the tip is for. What it leaves over is a contact of the body.
// All places along the arm are then tried, one in a tick, and the one that explains most names the segment. Laws,
// limits and measured errors: docs/explanation/contact-force.md.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/torque_balance.hpp"

namespace liana::cable {

constexpr std::uint8_t kContactSweeps = 2;  // looks at all angles in a row: 0.64 s
constexpr double kContactTip_N = 3.0;       // a push at the tip is explained up to this
constexpr double kContactMisfit = 2.0;      // of the rest, per angle: more is a contact of the body
constexpr double kContactMost_N = 30.0;     // deviation of a force that nothing shows
constexpr double kContactSeen_N = 1.0;      // a direction is told when it is surer than this
constexpr double kContactMoved_N = 0.5;     // the force has changed by so much: friction has found new places
constexpr std::uint32_t kPlaces = 4;        // tried along each segment
constexpr std::int32_t kFirstNamed = 1;     // 0-based segment: those before it cannot be told from motors

// What is known of friction: how sure a force is depends on it most.
enum class ContactState : std::uint8_t {
  kStuck,    // at rest: friction hides part of every push
  kMoving,   // cables slide as planned
  kDithered  // at rest, after a dither, and nothing has changed since
};

struct ContactDetectorState {
  ContactState state = ContactState::kStuck;
  Vec3 force_N{};                                             // at the tip, base frame
  Vec3 sd_N{kContactMost_N, kContactMost_N, kContactMost_N};  // its deviation along each axis
  Vec3 dithered_N{};                                          // the force after the last dither
  bool dithering = false;                                     // when it was looked at last
  double torque_Nm = 0.0;                                     // largest about any angle that it does not explain
  std::uint8_t sweeps = 0;                                    // in a row that felt the body, up to kContactSweeps
  std::int32_t segment = -1;  // 0-based, where the body is touched; -1: nowhere, or unknown

  TorqueMatrix root_Nm{};     // Cholesky factor of the torques' variances, the diagonal inverted
  ThetaVector torque{};       // what is to be explained, in its own deviations
  double least_misfit = 0.0;  // of all places tried in this round
  std::int32_t best_place = -1;
};

struct ContactConditions {
  bool moving;     // commanded faster than kMovingRate_rad_s
  bool dithering;  // a dither is under way, or has only just ended
};

// One look at all angles, after their round. `kinematics` as commanded.
void watch_contact(const RobotParams& table, const ArmKinematics& kinematics, const TorqueBalance& balance,
                   const ContactConditions& now, ContactDetectorState& contact) noexcept;

// Tries whether a contact at this place explains the last look; 0 to kPlaces times the segments, less one. Cost: three
// substitutions.
void try_place(const RobotParams& table, const ArmKinematics& kinematics, std::uint32_t place,
               ContactDetectorState& contact) noexcept;

// True while something has touched the body for kContactSweeps.
inline bool is_in_contact(const ContactDetectorState& contact) noexcept { return contact.sweeps >= kContactSweeps; }
// The force along this axis of the base is known.
inline bool is_seen(const ContactDetectorState& contact, std::size_t axis) noexcept {
  return contact.sd_N[axis] < kContactSeen_N;
}

}  // namespace liana::cable
