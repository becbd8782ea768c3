// Commands with known verdicts: each class of refusal just inside and just outside its limit, generated. What is known
// of them comes from the core's kinematics and from geometry that this file does by itself, not from the simulation.
#pragma once

#include <string>
#include <vector>

#include "host/simulate/simulation.hpp"
#include "host/verify/judge_simulated.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::verify::corpus {

struct Command {
  std::string name;
  cable::RobotTable table;
  double link_radius_m = 0.03;
  config::SceneConfig scene;
  cable::ThetaVector from_rad{}, to_rad{};
  double duration_s = 0.0;
  Refusal expected = Refusal::kNone;
};

std::vector<Command> joint_angles();
std::vector<Command> joint_rates();
std::vector<Command> tip_speeds();
std::vector<Command> node_speeds();
std::vector<Command> spheres();
std::vector<Command> ways_out();
std::vector<Command> thin_plates();
std::vector<Command> self_contacts();
std::vector<Command> swings();
std::vector<Command> free_motions();

// What the simulation end says of it.
SimulationVerdict verdict_of(const Command& command);

}  // namespace liana::verify::corpus
