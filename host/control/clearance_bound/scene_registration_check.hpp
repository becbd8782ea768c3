// Whether the scene stays where it is seen to stand: it cannot go anywhere. One that seems to is shown by a camera that
// is wrong so little at a time that each picture fits the one before.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "firmware_like/math/pose.hpp"

namespace liana::clearance_bound {

class SceneRegistrationCheck {
 public:
  explicit SceneRegistrationCheck(double tick_s) : tick_s_(tick_s) {}

  // Where the drawing's frame is seen to stand in the base; `tick` rises from call to call.
  void note(std::uint64_t tick, const Pose& drawing_in_base) {
    if (!first_tick_) first_tick_ = tick;
    if (since_s(tick, *first_tick_) < kSettled_s) return;
    const Seen now{tick, drawing_in_base};
    if (!newer_) older_ = newer_ = now;
    if (since_s(tick, newer_->tick) >= kHeld_s) {
      older_ = newer_;
      newer_ = now;
    }
  }
  // Where it was seen 20 to 40 s ago; asked for where something has moved.
  const Pose& before() const { return older_->drawing_in_base; }
  // How far a body at `where_m`, standing as in `drawing_in_base`, has seemed to go within the last 20 to 40 s, beyond
  // what right cameras show.
  double moved_m(const Pose& drawing_in_base, const Vec3& where_m) const {
    if (!older_) return 0.0;
    const Vec3 drawn_m = compose(inverse(drawing_in_base), {where_m, {1.0, 0.0, 0.0, 0.0}}).position_m;
    const Vec3 before_m = compose(older_->drawing_in_base, {drawn_m, {1.0, 0.0, 0.0, 0.0}}).position_m;
    return std::fmax(0.0, norm(subtract(where_m, before_m)) - kRight_m);
  }

 private:
  static constexpr double kSettled_s = 2.0;  // of the first pictures, in which it is found
  static constexpr double kHeld_s = 20.0;
  static constexpr double kRight_m = 0.001;  // found in the slit: 1.4 mm at most

  struct Seen {
    std::uint64_t tick = 0;
    Pose drawing_in_base{};
  };
  double since_s(std::uint64_t tick, std::uint64_t before) const {
    return static_cast<double>(tick - before) * tick_s_;
  }

  double tick_s_;
  std::optional<std::uint64_t> first_tick_;
  std::optional<Seen> older_, newer_;
};

}  // namespace liana::clearance_bound
