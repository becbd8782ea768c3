// What the self-test of the force estimate has read, and the table that is made of it
// (docs/explanation/contact-force.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/base/json/json.hpp"

namespace liana::report {

constexpr double kForceFound_N = 1.2;  // a force along the axes that are seen counts as found from here on

enum class ForceMoment { kStill, kDithered, kMoving };

// The estimate beside the truth, at one moment.
struct ForceReading {
  ForceMoment moment = ForceMoment::kStill;
  std::size_t configuration = 0;
  Vec3 true_N{};
  std::array<std::optional<double>, 3> told_N;  // nothing along an axis that is not seen
  Vec3 sd_N{};
};

// How soon a push was found after its first newton began to grow; nothing: not while it lasted.
struct ForceFound {
  ForceMoment moment = ForceMoment::kStill;
  double size_N = 0.0;
  std::optional<double> after_s;
};

// A fault that ended a configuration, and the push in force then.
struct ForceFault {
  int number = 0;
  double pushed_N = 0.0;
};

struct BodyNamed {
  std::int32_t segment = 0;  // that was pushed
  bool is_felt = false;
  std::int32_t named = 0;  // 0: not
};

struct ForceReadings {
  std::vector<ForceReading> readings;
  std::vector<ForceFound> found;
  std::vector<ForceFault> faults;
  std::vector<BodyNamed> body;
  std::vector<double> free_moving_N, free_resting_N;  // told while nothing pushes
};

// The table as JSON.
Json force_json(const ForceReadings& all);
// And as text.
std::string force_text(const Json& table);

}  // namespace liana::report
