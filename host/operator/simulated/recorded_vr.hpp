// A person with two VR handles, as a recording: played back with seeded tremor, glitches and tracking dropouts on top.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/operator/simulated/hand_recording.hpp"
#include "host/operator/simulated/temper.hpp"
#include "host/operator/simulated/tremor.hpp"

namespace liana::simulated {

// What the seed adds to a recording.
struct VrDisturbance {
  double tremor_m = 0.0002;       // RMS of each axis, of either hand
  double tremor_rad = 0.0005;     // RMS of each axis
  double jump_m = 0.25;           // one sample of the right hand this far away
  double dropout_least_s = 0.06;  // one loss of tracking of the right hand
  double dropout_most_s = 0.16;   // shorter than the 0.25 s after which the arbiter lets go
  double release_s = 0.4;         // lets go this long when the arm has stopped following, then grips again
  double patience_s = 0.6;        // trigger held without the arm following
};

// Plays one recording once; time stands still while the person re-grips, and while a lively one has
// lost the grip.
class RecordedVr {
 public:
  // The recording must not be empty.
  RecordedVr(VrRecording recording, const VrDisturbance& disturbance, std::uint64_t seed,
             Temper temper = Temper::kGentle);

  // Samples of the next `duration_s`, stamped from `now_s` on.
  std::vector<BothHands> advance(double now_s, double duration_s);
  // One sample of the hands while another device is used; nothing unless a lively person holds the handles as well.
  std::optional<BothHands> idle(double now_s);
  // Whether the arm follows, as the person sees it.
  void feel(bool engaged, double now_s);
  // True when the last sample has been played; the triggers are released from then on.
  bool finished() const { return next_ >= recording_.size(); }

 private:
  std::vector<BothHands> rest(double now_s, double duration_s);
  BothHands disturbed(const BothHands& recorded, double now_s);
  const BothHands& next_recorded() const { return recording_[std::min(next_, recording_.size() - 1)]; }
  bool has_grip(double now_s);
  void disturb_handle(device::Sample& handle, const Tremor& tremor, double now_s) const;

  VrRecording recording_;
  VrDisturbance disturbance_;
  Tremor right_tremor_;
  Tremor left_tremor_;
  std::optional<LivelyHands> lively_;
  std::size_t next_ = 0;
  double played_s_ = 0.0;  // position in the recording
  std::size_t jump_index_ = 0;
  double dropout_from_s_ = 0.0;
  double dropout_to_s_ = 0.0;
  Pose last_right_{};
  double followed_s_ = 0.0;        // when the arm last followed, or nothing was asked of it
  double still_s_ = 0.0;           // when the next sample of handles that are let go is due
  double release_until_s_ = -1.0;  // re-gripping until then
  bool gripping_ = false;
};

}  // namespace liana::simulated
