// Whether what the tip camera says can be believed.
#pragma once

#include <cstdint>
#include <optional>

#include "host/control/clearance_bound/registration.hpp"

namespace liana::clearance_bound {

enum class CameraStatus : std::uint8_t {
  kNone,
  kNoPicture,  // none has come for a while, or ever
  kTimeStamp,  // not later than the one before, or from the future
  kLate,       // older than its latency and kLateBy_s
  kFrozen,     // shows what was seen before, though the arm has moved
  kMirrored,   // fits what is expected when sides are exchanged
  kJumped,     // shows slit and rod where they cannot be
};
// "none", "no picture", "time stamp", "late", "frozen", "mirrored", "jumped".
const char* trouble_name(CameraStatus trouble);

class CameraMonitor {
 public:
  CameraMonitor(const config::SceneCamera& camera, double tick_s) : camera_(camera), tick_s_(tick_s) {}

  // What is wrong with `picture`, which has arrived at `tick`, by its time alone.
  CameraStatus judge_time(const Picture& picture, std::uint64_t tick);
  // What is wrong with what it shows: `measured` at its capture. A registration that has taken nothing in yet believes
  // anything near the drawing. After the first picture that is wrong the others are held against what was known before
  // it: what was not believed must not become believable by waiting.
  CameraStatus judge_view(const Picture& picture, const MeasuredArm& measured, const Registration& registration);

 private:
  bool is_believable(const Picture& picture, const MeasuredArm& measured) const;
  bool repeats(const Picture& picture) const;

  config::SceneCamera camera_;
  double tick_s_;
  std::optional<std::uint64_t> newest_;  // tick of capture
  std::optional<Picture> believed_;      // the last one
  std::optional<Registration> known_;    // before the first picture that was wrong; none: the last one was right
};

}  // namespace liana::clearance_bound
