// A gamepad as Linux gives it (joystick API, linux/joystick.h): sticks that move the tip while a shoulder button is
// held.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/operator/terminal/keys.hpp"

namespace liana::terminal {

// What sticks and buttons say, in the layout of the kernel's xpad driver; docs/how-to/teleoperate.md has it as a table.
class Sticks {
 public:
  static constexpr double kDeadZone = 0.15;  // of a stick's way: worn sticks do not come back to their middle

  // One event: `type` 1 a button, 2 an axis, with 0x80 added for what was so when the gamepad was opened; `value` of a
  // button 0 or 1, of an axis -32767 to 32767. Numbers that mean nothing here are ignored. The keys that it presses.
  std::vector<Key> take(std::uint8_t type, std::uint8_t number, std::int16_t value);
  // The shoulder button is held, and was pressed since the gamepad was opened and since another button was.
  bool is_held() const { return is_held_; }
  Direction direction() const;
  // Not held any more, before the shoulder button is pressed anew.
  void let_go() { is_held_ = false; }

 private:
  std::array<double, 8> axis_{};  // -1 to 1
  bool is_held_ = false;
};

// The file of one gamepad. Nothing waits for it.
class Gamepad {
 public:
  // Throws std::runtime_error, with what to do, where `path` cannot be read or is no device.
  explicit Gamepad(const std::string& path);
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;

  // A stick that leans moves by a little all the time, or leans as far as it goes. One that says nothing for so long is
  // let go: a gamepad out of reach says nothing either [s].
  static constexpr double kSilent_s = 2.0;

  // Takes in what came since; the keys that buttons have pressed. `now_s`: by a clock that never goes back.
  std::vector<Key> read(double now_s);
  // It has let go of the arm by its silence since the last call.
  bool take_silence() { return std::exchange(fell_silent_, false); }
  // It was unplugged, or its driver has ended.
  bool is_gone() const { return is_gone_; }
  // Nothing is held on a gamepad that is gone.
  bool is_held() const { return !is_gone_ && sticks_.is_held(); }
  Direction direction() const { return sticks_.direction(); }

 private:
  int fd_ = -1;
  bool is_gone_ = false;
  double heard_s_ = 0.0;
  bool fell_silent_ = false;
  Sticks sticks_;
};

}  // namespace liana::terminal
