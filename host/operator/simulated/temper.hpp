// What the hands of people who are not gentle add to what these people mean to do: bursts and moves to and fro, two
// hands against each other, a drifting hand, a strong tremor; grips that are lost and found again in motion; the other
// device taken up as well.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "host/base/random/random.hpp"
#include "host/operator/simulated/hand_gains.hpp"
#include "host/operator/simulated/slit_view.hpp"
#include "host/operator/simulated/tremor.hpp"

namespace liana::simulated {

enum class Temper : std::uint8_t { kGentle, kLively };

// gentle or lively; std::invalid_argument, with what is allowed, for another word.
Temper temper_called(const std::string& word);

// How lively people steer by hand: they start and brake harder, wait less for the arm, and settle for less,
// sooner.
HandGains in_haste(HandGains gains);

struct Range {
  double least = 0.0;
  double most = 0.0;
};

// What lively people do, at the hand. Of each range a seed draws one value for a person, or one for every gesture.
struct LivelyTable {
  bool has_left_hand = false;
  Range reach_m{0.005, 0.030};      // of a gesture, to either side of where the hand is meant to be; every gesture
  Range turn_rad{0.0, 0.25};        // of its turn, to either side; every gesture
  Range speed_m_s{0.10, 0.30};      // highest of a gesture; a person's, and from the least to that every gesture
  Range accel_m_s2{0.8, 2.0};       // the same of its acceleration
  double turn_rate_rad_s = 1.5;     // most
  double turn_accel_rad_s2 = 10;    // most
  Range gap_s{1.0, 5.0};            // rest between gestures; a person's mean, and half of that to one and a half
  Range losses_per_min{1.0, 3.0};   // grips lost in motion; a person's mean
  Range tremor_m{0.0002, 0.0005};   // RMS of each axis, 8 to 12 Hz; a person's
  double tremor_rad = 0.002;        // RMS of each axis
  Range drift_m{0.0005, 0.002};     // RMS of each axis, in periods of 30 to 120 s; a person's
  double drift_rad = 0.01;          // RMS of each axis
  Range other_every_s{10.0, 40.0};  // from one time with the other device to the next
  Range other_s{1.0, 5.0};          // how long it is held
};

// At two VR handles.
LivelyTable lively_at_handles();

// Deterministic: what the hands do is drawn from the seed alone. Only which gestures are left out depends on `careful`,
// and how far the drift is. Times do not go back.
class LivelyHands {
 public:
  // `purpose` separates the devices of one seed; it takes six numbers, this one and the next five.
  LivelyHands(const LivelyTable& table, std::uint64_t seed, std::uint64_t purpose);

  // The hands at `now_s`. `careful`: no gesture begins, and nothing drifts, as where people align.
  void advance(double now_s, bool careful);
  // Where the hand is that is meant to be at `meant`.
  Pose right(const Pose& meant) const;
  Pose left(const Pose& meant) const;
  // False while a grip is lost: from the fastest moment of one stroke to that of a later one.
  bool has_grip() const;
  // Whether the device that this is about is held while another one is used.
  bool is_taken_up() const { return now_s_ >= other_from_s_ && now_s_ < other_to_s_; }

 private:
  static constexpr std::size_t kMaxStrokes = 5;
  // Strokes from place to place, each half a cosine; places as shares of the reach, the first and the last one 0.
  struct Gesture {
    PoseStep reach{};
    double right_share = 1.0, left_share = 0.0;
    std::size_t strokes = 0;
    std::array<double, kMaxStrokes + 1> place{}, at_s{};
    double lost_from_s = 0.0, lost_to_s = 0.0;

    double end_s() const { return at_s[strokes]; }
    double share(double now_s) const;
    double fastest_s(std::size_t stroke) const { return 0.5 * (at_s[stroke] + at_s[stroke + 1]); }
  };

  double drawn(const Range& range) { return random_.uniform(range.least, range.most); }
  void plan(double from_s);
  void choose_hands(bool loses_grip);
  void choose_places(double from_s, bool loses_grip);
  void lose_grip();
  Pose moved_by(const Pose& meant, double share, const Tremor& drift, const Tremor& tremor) const;

  LivelyTable table_;
  RandomStream random_, other_;
  double speed_m_s_, accel_m_s2_, gap_s_, loss_every_s_;
  Tremor right_tremor_, left_tremor_, right_drift_, left_drift_;
  Gesture gesture_{};
  double next_loss_s_ = 0.0;
  double other_from_s_ = 0.0, other_to_s_ = 0.0;
  double now_s_ = 0.0, drift_s_ = 0.0;
  bool has_begun_ = false, is_left_out_ = false;
};

}  // namespace liana::simulated
