#include "host/operator/terminal/gamepad.hpp"

#include <fcntl.h>
#include <linux/joystick.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace liana::terminal {
namespace {

enum Axis : std::uint8_t { kLeftX = 0, kLeftY = 1, kRightX = 3, kRightY = 4, kCrossX = 6, kCrossY = 7 };
constexpr std::uint8_t kRightShoulder = 5;
constexpr double kFullWay = 32767.0;
constexpr std::size_t kMaxEvents = 64;  // in one read; what is left comes with the next

constexpr char kFrame = 'f';
constexpr std::array<std::pair<std::uint8_t, char>, 7> kButtons{{
    {0, 'h'},     // A
    {1, ' '},     // B
    {2, 'r'},     // X
    {3, kFrame},  // Y
    {4, 't'},     // left shoulder
    {6, 'b'},     // back
    {7, 'n'},     // start
}};

// 0 within the dead zone, and from there on evenly to 1.
double leant(double share) {
  const double beyond = std::fabs(share) - Sticks::kDeadZone;
  return beyond <= 0.0 ? 0.0 : std::copysign(std::min(1.0, beyond / (1.0 - Sticks::kDeadZone)), share);
}

}  // namespace

std::vector<Key> Sticks::take(std::uint8_t type, std::uint8_t number, std::int16_t value) {
  const bool at_start = (type & JS_EVENT_INIT) != 0;
  if ((type & ~JS_EVENT_INIT) == JS_EVENT_AXIS) {
    if (number < axis_.size()) axis_[number] = std::clamp(value / kFullWay, -1.0, 1.0);
    return {};
  }
  if ((type & ~JS_EVENT_INIT) != JS_EVENT_BUTTON || at_start) return {};
  if (number == kRightShoulder) is_held_ = value != 0;
  if (value == 0) return {};
  for (const auto& [button, key] : kButtons) {
    if (button != number) continue;
    is_held_ = is_held_ && key == kFrame;  // what was asked for is not undone by a stick that still leans
    return {*key_of(key)};
  }
  return {};
}

// A stick that is pushed away from the person gives negative numbers.
Direction Sticks::direction() const {
  const auto axis = [this](Axis which) { return leant(axis_[which]); };
  return {{-axis(kLeftY), -axis(kLeftX), -axis(kRightY)}, {axis(kCrossX), axis(kCrossY), -axis(kRightX)}};
}

Gamepad::Gamepad(const std::string& path) {
  fd_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  const std::string what = fd_ < 0 ? std::strerror(errno) : "";
  struct stat about {};
  const bool is_device = fd_ >= 0 && fstat(fd_, &about) == 0 && (S_ISCHR(about.st_mode) || S_ISFIFO(about.st_mode));
  if (is_device) return;
  if (fd_ >= 0) close(fd_);
  throw std::runtime_error("--gamepad: '" + path + "': " + (what.empty() ? "is no gamepad" : what) +
                           "; allowed: a joystick device like /dev/input/js0, which your user may read");
}

Gamepad::~Gamepad() { close(fd_); }

std::vector<Key> Gamepad::read(double now_s) {
  std::vector<Key> keys;
  std::array<js_event, kMaxEvents> events{};
  const ssize_t bytes = is_gone_ ? 0 : ::read(fd_, events.data(), sizeof events);
  if (bytes <= 0) {
    is_gone_ = is_gone_ || bytes == 0 || (errno != EAGAIN && errno != EINTR);
    const Direction leant = direction();
    const bool leans = norm(leant.way) + norm(leant.turn) > 0.0;
    if (!is_held() || !leans || now_s - heard_s_ < kSilent_s) return keys;
    sticks_.let_go();
    fell_silent_ = true;
    return keys;
  }
  heard_s_ = now_s;
  for (std::size_t i = 0; i < static_cast<std::size_t>(bytes) / sizeof(js_event); ++i) {
    const auto pressed = sticks_.take(events[i].type, events[i].number, events[i].value);
    keys.insert(keys.end(), pressed.begin(), pressed.end());
  }
  return keys;
}

}  // namespace liana::terminal
