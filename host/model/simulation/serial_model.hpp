// What the simulation knows of a serial arm: its rows, how thick it is, and the arm that it stands on.
#pragma once

#include <string>
#include <vector>

#include "host/model/clearance/clearance.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::simulation {

struct SerialModel {
  serial::RobotParams table{};
  double link_radius_m = 0.0;  // of the capsules of every link
  // Links of the arm that it stands on, from the root on; frame of this arm's base. A link may be two of them:
  // `base_of_link` says which one (0-based). Where its joints are locked, then, where it carries this arm there from
  // another pose, the same links there and at places between.
  std::vector<clearance::Capsule> base;
  std::vector<std::int32_t> base_of_link;  // of one place
  std::string base_name;
};

// What the arm carries: a capsule along the tip's z.
struct CarriedBody {
  double from_m = 0.0, to_m = 0.0;  // its axis, from the tip's origin
  double radius_m = 0.0;
};

// The capsule that ends where the payload does; of one that is thicker than long, a ball in its middle.
CarriedBody carried_body(const config::ScenePayload& payload);

// The model of a robot's table in a scene. Throws std::runtime_error where config::why_not_carried says why.
SerialModel serial_model(const config::SerialRobotConfig& robot, const config::SceneConfig& scene = {});

}  // namespace liana::simulation
