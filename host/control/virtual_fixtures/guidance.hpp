// Which plane of the scene guides a hand now, where it stands for the arm's commands, and which yaws it leaves.
//
// A plane guides in the planar modes: the pitch of the last segment is held, and the tip is in the fixture's box. The
// arm's tip is millimetres beside its command, so a command in the drawn plane would leave the tip beside it: the plane
// is moved by what the tip is believed to be off, low-passed, and the operator has that error taken off his hands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "host/control/virtual_fixtures/guide.hpp"
#include "host/control/virtual_fixtures/placed.hpp"

namespace liana::virtual_fixtures {

using namespace cable;  // this room serves the cable arm only

// Where the command stands, and what of it is held (bit i: theta i).
struct Commanded {
  Pose tip_in_base{};
  ThetaVector theta_rad{};
  std::uint32_t held_mask = 0;
};

// Names of fixtures that act; nothing: all that the scene has.
using Choice = std::optional<std::vector<std::string>>;

// How many segments from the tip on have their pitches held: 0, 1, 2 are 10+0, 9+1, 8+2.
std::int32_t planar_of_mask(const RobotParams& table, std::uint32_t held_mask);

class Guidance {
 public:
  Guidance() = default;  // no fixtures: every goal is as it was
  Guidance(const RobotParams& table, const std::vector<config::SceneFixture>& fixtures, double arm_radius_m);

  // From the next interval on. The hand that steers feels no step.
  void choose(const Choice& names) { choice_ = names; }
  // The scene has a fixture of this name.
  bool knows(const std::string& name) const;
  // Whether the fixture `name` may act.
  bool is_chosen(const std::string& name) const;
  // Once per command interval of `dt_s`.
  void see(const Sight& sight, double dt_s);
  // The goal to ask for in place of the hand's; once per interval while a hand steers. Two calls of
  // inverse_kinematics::fits at the least, 150 where the hand turns the tip beyond its yaws.
  Pose guide(const Pose& goal, const Commanded& now, double dt_s);
  // Nobody steers.
  void stop();

  // The plane that guides now, for commands; and its name, empty: none does.
  const std::optional<GuidePlane>& plane() const { return plane_; }
  const std::string& plane_name() const;
  // How far the hand asks to leave the plane, and whether its yaw is held back.
  double taken_away_m() const { return taken_away_m_; }
  bool is_yaw_limited() const { return yaw_limited_; }
  // What sight has come to, low-passed.
  const Sight& sight() const { return sight_; }
  const std::vector<config::SceneFixture>& fixtures() const { return fixtures_; }

 private:
  bool acts(std::size_t fixture, const Commanded& now) const;
  void find_plane(const Commanded& now);
  GuidePlane placed(const config::SceneFixture& fixture, const Commanded& now) const;
  void limit_yaw(const Pose& goal, const Commanded& now);

  RobotParams table_{};
  std::vector<config::SceneFixture> fixtures_;
  double arm_radius_m_ = 0.0;
  Choice choice_;
  Sight sight_;
  bool has_seen_ = false;
  Guide guide_;
  std::optional<GuidePlane> plane_;
  std::optional<std::size_t> active_;  // of fixtures_
  double taken_away_m_ = 0.0;
  bool yaw_limited_ = false;
};

}  // namespace liana::virtual_fixtures
