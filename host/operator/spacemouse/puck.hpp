// The puck of a SpaceMouse as a hand: how far it is pushed and turned is how fast the hand goes.
#pragma once

#include <array>

#include "host/api/device/sample.hpp"

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

// A puck that is pushed says so again and again, 60 to 125 times a second; one that is asleep, out of reach or
// unplugged says nothing more, and spacenavd repeats its last word for ever where it was told to (repeat-interval).
constexpr double kPuckSilent_s = 0.06;  // so long after its last word a pushed puck is not pushed any more
constexpr double kPuckVaries_s = 0.2;   // one whose words differed for so long: a word repeated is none
constexpr double kPuckSteady_s = 1.0;   // any other one may repeat itself for so long

// Where the hand goes in the device frame: x ahead, y left, z up, as the person sits behind the arm's base.
device::Twist twist_of(const PuckTable& table, const Deflection& deflection);

// Deterministic: the same calls give the same hand, whatever the machine.
class Puck {
 public:
  explicit Puck(const PuckTable& table) : table_(table) {}

  // The puck's word, as it has come.
  void push(const Deflection& deflection);
  // It was unplugged.
  void lose();
  // Button `number` is pressed or let go.
  void press(int number, bool is_pressed);
  // The hand `step_s` later. With an open deadman it begins anew from its middle. Of a puck that is pushed and says no
  // more the sample is stale, with an open deadman, until it was let go: came to rest, or its button was.
  device::Sample step(std::int64_t t_us, double step_s);

 private:
  bool is_moved() const;
  void grow_old(double step_s);

  PuckTable table_;
  Deflection deflection_{};
  std::uint32_t buttons_ = 0;
  double rests_s_ = 1e9;
  double silent_s_ = 0.0, same_s_ = 0.0;   // pushed, since its last word, and since the last one that differed
  double varies_s_ = 0.0;                  // pushed, without a word said twice
  bool is_told_ = false, is_new_ = false;  // since the last step: a word, one that differs
  bool is_stale_ = false;
  Pose pose_{};
};

}  // namespace liana::spacemouse
