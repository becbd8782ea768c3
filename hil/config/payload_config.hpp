// A payload and the adapter that it goes into, as a scene table has them (docs/reference/formats.md).
#pragma once

#include <optional>
#include <string>

#include "hil/config/json_file.hpp"
#include "hil/config/serial_config.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

struct PayloadConfig {
  BodyConfig body;         // in its own frame: the origin at its grapple, z towards its pins
  double length_m = 0.0;   // from the grapple to the plane of the pins' tips
  double radius_m = 0.0;   // of a capsule about that line, with all that belongs to it
  Pose pose;               // where the transfer mechanism holds it, base frame
  std::string fetch_pose;  // of the arm that carries, while the mechanism hands the payload over; empty: where it locks
  bool on_arm = false;     // the arm has it from the start, before the adapter, as servo would have brought it there
  double start_lateral_m = 0.0;  // with `on_arm`: so far beside the adapter's axis at most, in x and in y
  double start_tilt_rad = 0.0;   // and so much turned at most
};

struct AdapterConfig {
  Pose pose;  // the middle of the socket's face, z into it, base frame
};

// Throw std::runtime_error naming file, field, value and allowed range; nothing where the scene has none.
std::optional<PayloadConfig> read_payload(const JsonFile& file);
std::optional<AdapterConfig> read_adapter(const JsonFile& file);

}  // namespace liana::bench
