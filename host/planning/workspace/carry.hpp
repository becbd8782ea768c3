// What a cable arm can carry: the tensions of the core's plan at rest (firmware_like/cable/arm/static_load.hpp) beside
// the table's limits, over its poses, with gravity from every side, and how much more its tip may weigh.
//
// Poses are drawn evenly within the limits of the angles, every other one pulled towards the straight arm; from the
// hardest of them one angle after the other goes to the end of its range where that asks for more tension. Found is so
// a pose that is hard, and not always the hardest.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/model/config/config.hpp"

namespace liana::workspace {

// Where the largest tension at a motor lies; slack cables and cables that cannot balance a pose are beyond.
enum class TensionBand : std::uint8_t { kFree, kOverCeiling, kOverAlarm, kBeyond };
constexpr std::size_t kTensionBands = 4;

// The plan at one pose, nothing having slipped. A drive of a base counts where it holds more than the hard limit.
struct PoseTension {
  double max_N = 0.0;  // at the motors
  double min_N = 0.0;
  std::size_t max_cable = 0;  // 0-based
  std::size_t min_cable = 0;
  bool balanced = true;
};
PoseTension tension_at(const cable::RobotParams& table, const cable::ThetaVector& theta_rad);
// The same in a named pose of its table.
PoseTension tension_at(const config::RobotConfig& robot, const std::string& name);
// Why cables cannot hold it there, and what to do. Empty: they can.
std::string refusal_of_pose(const config::RobotConfig& robot, const std::string& name);
TensionBand band_of(const cable::TensionLimits& limits, const PoseTension& tension);

// Gravity in the base frame, x along the straight arm.
struct Mounting {
  std::string name;
  Vec3 gravity_m_s2{};
};
// The table's own; then base up (the arm hangs), base down (it stands), and four ways to lie, with
// the table's amount of gravity, else the standard one (9.80665 m/s2, ISO 80000-3).
std::vector<Mounting> mountings(const cable::RobotParams& table);

struct CarriedPose {
  Vec3 tip_in_base_m{};
  TensionBand band = TensionBand::kFree;
};

// Largest mass [kg] at the tip, beside the table's tool, with which all poses of a set keep floor and ceiling, to 1 g;
// and the cable that ends it there. 0 with `unloaded` false where a pose does not even without.
struct Payload {
  double mass_kg = 0.0;
  bool unloaded = true;
  std::size_t cable = 0;   // 0-based
  double tension_N = 0.0;  // of that cable, with 1 g more
  cable::ThetaVector theta_rad{};
};
constexpr double kMaxPayload_kg = 1000.0;

struct Carried {
  Mounting mounting;
  std::vector<CarriedPose> poses;
  std::array<double, kTensionBands> share{};  // of the drawn poses
  PoseTension worst;                          // of all
  cable::ThetaVector worst_rad{};
  Payload named, all;  // of the table's named poses; of the named, the drawn and the hardest
};

// Same arm, samples and seed: same result. Cost: about 10 us a sample and mounting, and the payloads as much again.
Carried what_it_carries(const config::RobotConfig& robot, const Mounting& mounting, std::int32_t samples,
                        std::uint64_t seed);

// One side view for every mounting: cells have the worst band of the tip places in them.
std::string carry_picture(const config::RobotConfig& robot, const std::vector<Carried>& carried);

}  // namespace liana::workspace
