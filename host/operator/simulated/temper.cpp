#include "host/operator/simulated/temper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace liana::simulated {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBurst = 0.4;       // of the gestures: out, and after a while back; the others go to and fro
constexpr double kAgainst = 0.35;    // of those of two hands: one against the other
constexpr double kLeftAlone = 0.15;  // of those of two hands
constexpr double kMinPause_s = 0.2;  // of a burst before it goes back
constexpr double kMaxPause_s = 1.0;
constexpr double kSlowestDrift_hz = 1.0 / 120.0, kFastestDrift_hz = 1.0 / 30.0;

// In any direction.
Vec3 drawn_vector(RandomStream& random, const Range& length) {
  const Vec3 v{random.normal(1.0), random.normal(1.0), random.normal(1.0)};
  const double drawn = random.uniform(length.least, length.most);
  return norm(v) > 0.0 ? scale(v, drawn / norm(v)) : Vec3{drawn, 0.0, 0.0};
}

// Of half a cosine over `way` that neither exceeds the speed nor the acceleration.
double stroke_s(double way, double speed, double accel) {
  return std::max(kPi * way / (2.0 * speed), kPi * std::sqrt(way / (2.0 * accel)));
}

}  // namespace

Temper temper_called(const std::string& word) {
  if (word == "gentle") return Temper::kGentle;
  if (word == "lively") return Temper::kLively;
  throw std::invalid_argument("'" + word + "': allowed gentle or lively");
}

HandGains in_haste(HandGains gains) {
  gains.accel_m_s2 *= 3.0;
  gains.wait_from_m *= 2.0;
  gains.wait_full_m *= 2.0;
  gains.relent_s /= 4.0;
  gains.relent_most += 0.5;
  gains.align_relent_most += 1.0;
  return gains;
}

LivelyTable lively_at_handles() {
  LivelyTable table;
  table.has_left_hand = true;
  table.reach_m = {0.010, 0.050};
  return table;
}

double LivelyHands::Gesture::share(double now_s) const {
  for (std::size_t i = 0; i < strokes; ++i) {
    if (now_s < at_s[i] || now_s >= at_s[i + 1]) continue;
    const double walked = 0.5 * (1.0 - std::cos(kPi * (now_s - at_s[i]) / (at_s[i + 1] - at_s[i])));
    return place[i] + walked * (place[i + 1] - place[i]);
  }
  return 0.0;
}

LivelyHands::LivelyHands(const LivelyTable& table, std::uint64_t seed, std::uint64_t purpose)
    : table_(table),
      random_(seed, purpose),
      other_(seed, purpose + 1),
      speed_m_s_(random_.uniform(0.5 * (table.speed_m_s.least + table.speed_m_s.most), table.speed_m_s.most)),
      accel_m_s2_(random_.uniform(0.5 * (table.accel_m_s2.least + table.accel_m_s2.most), table.accel_m_s2.most)),
      gap_s_(drawn(table.gap_s)),
      loss_every_s_(60.0 / drawn(table.losses_per_min)),
      right_tremor_(drawn(table.tremor_m), table.tremor_rad, seed, purpose + 2),
      left_tremor_(drawn(table.tremor_m), table.tremor_rad, seed, purpose + 3),
      right_drift_(drawn(table.drift_m), table.drift_rad, seed, purpose + 4, kSlowestDrift_hz, kFastestDrift_hz),
      left_drift_(drawn(table.drift_m), table.drift_rad, seed, purpose + 5, kSlowestDrift_hz, kFastestDrift_hz),
      next_loss_s_(random_.uniform(0.0, loss_every_s_)) {
  plan(0.0);
}

// The next gesture, some time after `after_s`.
void LivelyHands::plan(double after_s) {
  const double from_s = after_s + gap_s_ * random_.uniform(0.5, 1.5);
  const bool loses_grip = from_s >= next_loss_s_;
  gesture_ = {};
  gesture_.reach = {drawn_vector(random_, table_.reach_m), drawn_vector(random_, table_.turn_rad)};
  choose_hands(loses_grip);
  choose_places(from_s, loses_grip);
  if (loses_grip) lose_grip();
  has_begun_ = is_left_out_ = false;
}

// The right hand loses a grip, so it moves then.
void LivelyHands::choose_hands(bool loses_grip) {
  const double which = random_.uniform(0.0, 1.0);
  if (!table_.has_left_hand) return;
  const bool is_left_alone = which >= kAgainst && which < kAgainst + kLeftAlone && !loses_grip;
  gesture_.left_share = which < kAgainst ? -1.0 : is_left_alone ? 1.0 : 0.0;
  gesture_.right_share = is_left_alone ? 0.0 : 1.0;
}

void LivelyHands::choose_places(double from_s, bool loses_grip) {
  const double speed_m_s = random_.uniform(table_.speed_m_s.least, speed_m_s_);
  const double accel_m_s2 = random_.uniform(table_.accel_m_s2.least, accel_m_s2_);
  const bool is_burst = random_.uniform(0.0, 1.0) < kBurst && !loses_grip;
  const auto most = static_cast<double>(kMaxStrokes);
  gesture_.strokes = is_burst ? 3 : static_cast<std::size_t>(random_.uniform(3.0, most + 1.0));
  gesture_.at_s[0] = from_s;
  for (std::size_t i = 0; i < gesture_.strokes; ++i) {
    const bool is_last = i + 1 == gesture_.strokes;
    gesture_.place[i + 1] = is_last ? 0.0 : is_burst || i % 2 == 0 ? 1.0 : -1.0;
    const double share = std::fabs(gesture_.place[i + 1] - gesture_.place[i]);
    const double way_s =
        std::max(stroke_s(share * norm(gesture_.reach.shift_m), speed_m_s, accel_m_s2),
                 stroke_s(share * norm(gesture_.reach.turn_rad), table_.turn_rate_rad_s, table_.turn_accel_rad_s2));
    gesture_.at_s[i + 1] = gesture_.at_s[i] + (share > 0.0 ? way_s : random_.uniform(kMinPause_s, kMaxPause_s));
  }
}

// Let go at the fastest moment of one stroke, gripped again at that of a later one.
void LivelyHands::lose_grip() {
  const auto strokes = static_cast<double>(gesture_.strokes);
  const auto from = static_cast<std::size_t>(random_.uniform(0.0, strokes - 1.0));
  const auto to = static_cast<std::size_t>(random_.uniform(static_cast<double>(from) + 1.0, strokes));
  gesture_.lost_from_s = gesture_.fastest_s(from);
  gesture_.lost_to_s = gesture_.fastest_s(to);
  next_loss_s_ += loss_every_s_ * random_.uniform(0.5, 1.5);
}

void LivelyHands::advance(double now_s, bool careful) {
  if (!careful) drift_s_ += now_s - now_s_;
  now_s_ = now_s;
  while (now_s_ >= gesture_.end_s()) plan(gesture_.end_s());
  if (!has_begun_ && now_s_ >= gesture_.at_s[0]) {
    has_begun_ = true;
    is_left_out_ = careful;
  }
  while (now_s_ >= other_to_s_) {
    const Range &every = table_.other_every_s, &lasts = table_.other_s;
    other_from_s_ = other_to_s_ + other_.uniform(every.least, every.most);
    other_to_s_ = other_from_s_ + other_.uniform(lasts.least, lasts.most);
  }
}

bool LivelyHands::has_grip() const {
  return is_left_out_ || now_s_ < gesture_.lost_from_s || now_s_ >= gesture_.lost_to_s;
}

Pose LivelyHands::moved_by(const Pose& meant, double share, const Tremor& drift, const Tremor& tremor) const {
  const double way = is_left_out_ ? 0.0 : share * gesture_.share(now_s_);
  const Pose led = moved(meant, {scale(gesture_.reach.shift_m, way), scale(gesture_.reach.turn_rad, way)});
  return tremor.apply(drift.apply(led, drift_s_), now_s_);
}

Pose LivelyHands::right(const Pose& meant) const {
  return moved_by(meant, gesture_.right_share, right_drift_, right_tremor_);
}

Pose LivelyHands::left(const Pose& meant) const {
  return moved_by(meant, gesture_.left_share, left_drift_, left_tremor_);
}

}  // namespace liana::simulated
