// One table, read by the host for the core and by the bench for itself.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "hil/config/serial_config.hpp"
#include "host/model/config/serial_robot.hpp"
#include "tests/host/model/config/tables.hpp"
#include "tests/temporary_folder.hpp"

namespace liana::test {

// As the bench reads it: from a file.
inline bench::SerialRobotConfig bench_robot(const Json& table) {
  return bench::load_serial_robot(program_folder().write("serial.json", table.dump()));
}

// Repeatable random numbers.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;
  }
  serial::JointVector joints(std::size_t count, double most) {
    serial::JointVector out{};
    for (std::size_t i = 0; i < count; ++i) out[i] = in(-most, most);
    return out;
  }
  Vec3 vector(double most) { return {in(-most, most), in(-most, most), in(-most, most)}; }
  // A body as there can be one: its second moments of mass are those of three rods of any direction.
  serial::LinkMass body(double max_kg) {
    serial::LinkMass body{in(0.2, 1.0) * max_kg, vector(0.5), {}};
    for (int rod = 0; rod < 3; ++rod) {
      const Vec3 x = vector(0.3);
      const double m = body.mass_kg / 3.0, square = dot(x, x);
      for (std::size_t k = 0; k < 3; ++k) body.inertia_kgm2[k] += m * (square - x[k] * x[k]);
      body.inertia_kgm2[serial::kXy] -= m * x[0] * x[1];
      body.inertia_kgm2[serial::kXz] -= m * x[0] * x[2];
      body.inertia_kgm2[serial::kYz] -= m * x[1] * x[2];
    }
    return body;
  }

 private:
  std::mt19937_64 engine_;
};

inline Json link_json(const serial::LinkMass& body) {
  return {{"mass_kg", body.mass_kg}, {"center_m", body.center_m}, {"inertia_kgm2", body.inertia_kgm2}};
}

// The small arm without its last joint, with other twists, offsets and links of every shape.
inline Json six_odd_joints() {
  Json table = config::good_table("robot", "micro");
  Numbers numbers(6);
  table["joints"].erase(6);
  for (Json& joint : table["joints"]) {
    joint["alpha_deg"] = numbers.in(-180, 180);
    joint["a_m"] = numbers.in(-1, 1);
    joint["d_m"] = numbers.in(-1, 1);
    joint["offset_deg"] = numbers.in(-90, 90);
    joint["link"] = link_json(numbers.body(50.0));
  }
  table.erase("mass");
  for (const char* list : {"direction", "zero_counts"}) table["drives"][list].erase(6);
  table["named_poses_deg"] = Json{{"zero", std::vector<double>(6, 0.0)}};
  return table;
}

}  // namespace liana::test
