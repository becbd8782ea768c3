// Commands with known verdicts: each class of refusal just inside and just outside its limit, generated. What is known
// of them comes from the core's kinematics and from geometry that this file does by itself, not from the simulation.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/control/verification/judge_simulated.hpp"
#include "host/model/simulation/simulation.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::verification::corpus {

struct Command {
  std::string name;
  cable::RobotParams table;
  double link_radius_m = 0.03;
  config::SceneConfig scene;
  cable::ThetaVector from_rad{}, to_rad{};
  double duration_s = 0.0;
  Refusal expected = Refusal::kNone;
};

// Boxes and convex bodies beside the way: along the axes or turned, flat, like a needle; hulls, capsules, cylinders.
std::vector<Command> boxes(std::uint64_t seed);
std::vector<Command> convex_bodies(std::uint64_t seed);

// A class: its name, its commands, and how many there are at least.
struct Class {
  const char* name;
  std::vector<Command> (*commands)(std::uint64_t seed);
  std::size_t least;
};
extern const std::array<Class, 12> kClasses;

// What the simulation end says of it.
SimulationVerdict verdict_of(const Command& command);

}  // namespace liana::verification::corpus
