// The puck of a SpaceMouse as a hand: how far it is pushed and turned is how fast the hand goes.
#pragma once

#include <array>

#include "host/device/sample.hpp"

namespace liana::spacemouse {

// What spacenavd says of the puck: pushed right, up, away from the person, and turned about these axes; about +-350.
using Deflection = std::array<int, 6>;

struct PuckTable {
  double speed_m_s = 0.05;  // of the hand, with the puck pushed all the way; 0.001 .. 1
  double turn_rad_s = 0.5;  // 0.01 .. 5
  int full = 350;           // counts all the way
  int dead = 20;            // so little is a puck at rest
  int button = -1;          // the deadman; -1: the puck itself, which is held while it is moved
  double let_go_s = 0.15;   // without a button: so long after the puck has come to rest the deadman opens
};

// Where the hand goes in the device frame: x ahead, y left, z up, as the person sits behind the arm's base.
device::Twist twist_of(const PuckTable& table, const Deflection& deflection);

// Deterministic: the same calls give the same hand, whatever the machine.
class Puck {
 public:
  explicit Puck(const PuckTable& table) : table_(table) {}

  void push(const Deflection& deflection) { deflection_ = deflection; }
  // Button `number` is pressed or let go.
  void press(int number, bool is_pressed);
  // The hand `step_s` later. With an open deadman it begins anew from its middle.
  device::Sample step(std::int64_t t_us, double step_s);

 private:
  bool is_moved() const;

  PuckTable table_;
  Deflection deflection_{};
  std::uint32_t buttons_ = 0;
  double rests_s_ = 1e9;
  Pose pose_{};
};

}  // namespace liana::spacemouse
