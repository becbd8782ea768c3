#include "host/operator/simulated/recorded_vr.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/base/random/random.hpp"

namespace liana::simulated {

namespace {
constexpr std::uint64_t kRightTremorPurpose = 11;
constexpr std::uint64_t kLeftTremorPurpose = 12;
constexpr std::uint64_t kGlitchPurpose = 13;
constexpr std::uint64_t kLivelyRecordingPurpose = 91;  // to 96
constexpr double kCareful_s = 6.0;                     // before its end no gesture begins: where it ends, nobody looks
constexpr double kStillStep_s = 1.0 / 90.0;

std::int64_t microseconds(double time_s) { return std::llround(time_s * 1e6); }

void open_triggers(BothHands& hands) {
  for (device::Sample* hand : {&hands.right, &hands.left}) {
    hand->trigger = 0.0;
    hand->deadman = false;
  }
}
}  // namespace

RecordedVr::RecordedVr(VrRecording recording, const VrDisturbance& disturbance, std::uint64_t seed, Temper temper)
    : recording_(std::move(recording)),
      disturbance_(disturbance),
      right_tremor_(disturbance.tremor_m, disturbance.tremor_rad, seed, kRightTremorPurpose),
      left_tremor_(disturbance.tremor_m, disturbance.tremor_rad, seed, kLeftTremorPurpose) {
  if (recording_.empty())
    throw std::runtime_error("VR recording: no samples: allowed at least one; give another recording");
  if (temper == Temper::kLively) lively_.emplace(lively_at_handles(), seed, kLivelyRecordingPurpose);
  RandomStream random(seed, kGlitchPurpose);
  const double end_s = static_cast<double>(recording_.back().right.t_us) * 1e-6;
  jump_index_ = static_cast<std::size_t>(random.uniform(0.1, 0.45) * static_cast<double>(recording_.size()));
  dropout_from_s_ = random.uniform(0.5, 0.9) * end_s;
  dropout_to_s_ = dropout_from_s_ + random.uniform(disturbance.dropout_least_s, disturbance.dropout_most_s);
}

void RecordedVr::disturb_handle(device::Sample& handle, const Tremor& tremor, double now_s) const {
  if (handle.valid) handle.pose = tremor.apply(handle.pose, now_s);
}

BothHands RecordedVr::disturbed(const BothHands& recorded, double now_s) {
  BothHands sample = recorded;
  sample.right.t_us = sample.left.t_us = microseconds(now_s);
  if (lively_) {
    const bool held = has_grip(now_s);
    sample.right.pose = lively_->right(sample.right.pose);
    sample.left.pose = lively_->left(sample.left.pose);
    if (!held) open_triggers(sample);
  }
  disturb_handle(sample.right, right_tremor_, now_s);
  disturb_handle(sample.left, left_tremor_, now_s);
  if (next_ == jump_index_) sample.right.pose.position_m[1] += disturbance_.jump_m;
  if (played_s_ >= dropout_from_s_ && played_s_ < dropout_to_s_) {
    sample.right.valid = false;
    sample.right.pose = last_right_;
  }
  last_right_ = sample.right.pose;
  return sample;
}

std::vector<BothHands> RecordedVr::advance(double now_s, double duration_s) {
  if (finished() || now_s < release_until_s_ || !has_grip(now_s)) return rest(now_s, duration_s);
  std::vector<BothHands> samples;
  const double start_s = played_s_;
  while (!finished() && static_cast<double>(recording_[next_].right.t_us) * 1e-6 < start_s + duration_s) {
    played_s_ = static_cast<double>(recording_[next_].right.t_us) * 1e-6;
    samples.push_back(disturbed(recording_[next_], now_s + (played_s_ - start_s)));
    gripping_ = samples.back().right.deadman;
    ++next_;
  }
  played_s_ = start_s + duration_s;
  return samples;
}

// Handles that are let go are sampled all the same.
std::vector<BothHands> RecordedVr::rest(double now_s, double duration_s) {
  gripping_ = false;
  std::vector<BothHands> samples;
  for (still_s_ = std::max(still_s_, now_s); still_s_ < now_s + duration_s; still_s_ += kStillStep_s) {
    samples.push_back(disturbed(next_recorded(), still_s_));
    open_triggers(samples.back());
  }
  return samples;
}

bool RecordedVr::has_grip(double now_s) {
  if (!lively_) return true;
  const double end_s = static_cast<double>(recording_.back().right.t_us) * 1e-6;
  lively_->advance(now_s, end_s - played_s_ < kCareful_s);
  return lively_->has_grip();
}

std::optional<BothHands> RecordedVr::idle(double now_s) {
  if (!lively_) return std::nullopt;
  lively_->advance(now_s, false);
  if (!lively_->is_taken_up()) return std::nullopt;
  BothHands hands = disturbed(next_recorded(), now_s);
  for (device::Sample* hand : {&hands.right, &hands.left}) {
    hand->trigger = 1.0;
    hand->deadman = true;
  }
  return hands;
}

void RecordedVr::feel(bool engaged, double now_s) {
  if (engaged || !gripping_) followed_s_ = now_s;
  if (now_s - followed_s_ > disturbance_.patience_s) {
    release_until_s_ = now_s + disturbance_.release_s;
    followed_s_ = release_until_s_;
  }
}

}  // namespace liana::simulated
