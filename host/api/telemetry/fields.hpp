// The numbers of a state that change all the time: where they stand in it (docs/reference/api.md), and their units.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace liana::telemetry {

enum class Shape : std::uint8_t {
  kOne,     // a number
  kThree,   // a vector
  kFive,    // of a verdict: what it left of five limits
  kPose,    // position and quaternion
  kJoints,  // one for each angle of the arm, or empty
  kFound,   // as many as the state has: an array of numbers, or of arrays of numbers
  kEach,    // one of each entry of an array of objects
};

// `path`: names of members with dots between them; of kEach the array and a member of its entries.
struct Field {
  std::string_view path;
  std::string_view unit;
  Shape shape = Shape::kOne;
};

// In the order in which records hold them. Not every arm's states have all.
extern const std::array<Field, 63> kFields;

}  // namespace liana::telemetry
