// What of a robot bounds the requests of its clients, whatever kind of arm it has.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::api {

// Kinds of arm, one bit each; a set of them says for which an operation exists.
using Arms = std::uint8_t;
constexpr Arms kCableArm = 1, kSerialArm = 2, kEveryArm = kCableArm | kSerialArm;

// A number of the robot that ranges are made of.
enum class Figure : std::uint8_t { kOne, kReach, kAngles, kAngleRate, kTipSpeed, kNodes };

// One end of a range, or a default: `factor` times a figure of the robot; kOne makes it a plain number.
struct Bound {
  double factor = 0.0;
  Figure figure = Figure::kOne;

  constexpr Bound() = default;
  constexpr Bound(double number) : factor(number) {}
  constexpr Bound(Figure of, double times = 1.0) : factor(times), figure(of) {}
};

// Where an angle of the arm may be.
struct AngleRange {
  double low_deg = 0.0;
  double high_deg = 0.0;
};

// Plain numbers of one robot.
struct RequestBounds {
  Arms arm = kCableArm;
  std::string robot;                  // its name, for messages
  std::vector<AngleRange> angle_deg;  // of every angle of a joint goal, in its order
  double angle_rate_deg_s = 0.0;      // the fastest that a joint motion may ask for
  double tip_speed_m_s = 0.0;
  double tip_rate_deg_s = 0.0;
  double reach_m = 0.0;    // farthest that the tip can be from the base
  std::int32_t nodes = 0;  // between base and tip, that a client can steer; 0: none

  // What an angle is called in messages: "theta" or "joint".
  const char* angle_name() const { return arm == kCableArm ? "theta" : "joint"; }
  double value_of(const Bound& bound) const;
};

// From a robot's canonical JSON of kind "robot" or "serial" (docs/reference/formats.md), which is in the units of the
// API. Throws JsonError when a figure is missing.
RequestBounds request_bounds(const Json& robot);

}  // namespace liana::api
