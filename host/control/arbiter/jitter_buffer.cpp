#include "host/control/arbiter/jitter_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/operator_input/tip_interval.hpp"
#include "host/control/arbiter/hand_track.hpp"

namespace liana::arbiter {

namespace {

constexpr std::int64_t kGap_us = 15'000;    // longer without a sample: some are missing
constexpr std::int64_t kBridge_us = 5'000;  // apart: what is put in between
constexpr double kHurry = 1.05;             // a wait that has become shorter is made up for by so much

device::Sample sample_between(const device::Sample& from, const device::Sample& to, std::int64_t t_us) {
  device::Sample out = to;
  const double share = static_cast<double>(t_us - from.t_us) / static_cast<double>(to.t_us - from.t_us);
  const Vec3 turn_rad = rotation_vector(multiply(to.pose.quaternion, conjugate(from.pose.quaternion)));
  out.t_us = t_us;
  out.pose = interpolated_pose(from.pose, to.pose, turn_rad, share);
  return out;
}

bool leads(const device::Sample& sample) { return sample.valid && sample.deadman; }

bool is_one_way(const device::Sample& from, const device::Sample& to) {
  const std::int64_t gap_us = to.t_us - from.t_us;
  return gap_us > kGap_us && gap_us <= std::llround(1e6 * kTrackingLost_s) && leads(from) && leads(to);
}

}  // namespace

void JitterBuffer::add(const device::Sample& sample) {
  if (!newest_) play_us_ = sample.t_us;
  if (newest_ && waits_) bridge(sample);
  queue_.push_back(sample);
  newest_ = sample;
  if (sample.deadman) return;
  play_us_ = std::max(play_us_, sample.t_us);
  if (!is_late_) return;
  before_.reset();
  now_.reset();
  is_late_ = false;
}

void JitterBuffer::bridge(const device::Sample& to) {
  if (!is_one_way(*newest_, to)) return;
  for (std::int64_t t_us = newest_->t_us + kBridge_us; t_us < to.t_us; t_us += kBridge_us) {
    if (t_us > play_us_) queue_.push_back(sample_between(*newest_, to, t_us));
  }
}

// An age far beyond the best says that nothing comes, which no wait bridges.
void JitterBuffer::note(std::int64_t age_us) {
  if (arm_us_ - window_us_ > kWindow_us) {
    before_ = now_;
    now_.reset();
    window_us_ = arm_us_;
  }
  is_late_ = (now_ || before_) && age_us > ages().min_us + kMaxWait_us;
  if (is_late_) return;
  if (!now_) now_ = Ages{age_us, age_us};
  now_ = Ages{std::min(now_->min_us, age_us), std::max(now_->max_us, age_us)};
}

JitterBuffer::Ages JitterBuffer::ages() const {
  if (!now_ || !before_) return now_ ? *now_ : before_.value_or(Ages{});
  return {std::min(now_->min_us, before_->min_us), std::max(now_->max_us, before_->max_us)};
}

void JitterBuffer::go_on(std::int64_t interval_us) {
  const Ages age = ages();
  const bool is_even = age.max_us - age.min_us <= interval_us;
  waits_ = !is_even || (waits_ && !queue_.empty());
  if (!waits_) {
    play_us_ = newest_->t_us;
    return;
  }
  const std::int64_t due_us = arm_us_ - (is_even ? age.min_us : age.max_us);
  const std::int64_t soonest_us = play_us_ + std::llround(kHurry * static_cast<double>(interval_us));
  play_us_ = std::max({play_us_, std::min(due_us, soonest_us), newest_->t_us - kMaxWait_us});
}

std::vector<device::Sample> JitterBuffer::finish_interval(double interval_s) {
  const std::int64_t interval_us = std::llround(1e6 * interval_s);
  arm_us_ += interval_us;
  if (!newest_) return {};
  note(arm_us_ - newest_->t_us);
  go_on(interval_us);
  const auto end = std::find_if(queue_.begin(), queue_.end(), [&](const auto& s) { return s.t_us > play_us_; });
  std::vector<device::Sample> due(queue_.begin(), end);
  queue_.erase(queue_.begin(), end);
  return due;
}

}  // namespace liana::arbiter
