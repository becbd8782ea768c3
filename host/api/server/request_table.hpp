// The requests of the API in one table: what lianad checks, who may ask, what missions can send, the stubs of `arm` and
// docs/reference/api.md follow from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "host/api/server/request_bounds.hpp"
#include "host/api/server/role.hpp"

namespace liana::api {

enum class FieldType : std::uint8_t {
  kNumber,   // in [low, high]
  kInteger,  // whole, in [low, high]
  kFlag,     // true or false (also 1 or 0)
  kText,     // 1 to `high` bytes
  kWord,     // one of `words`
  kAngle,    // degrees, in the range of the angle whose number the field "theta" beside it is
  kAngles,   // degrees, one for each angle of the arm, each in its range
  kPoint,    // [x,y,z] in metres, each within +-high
  kPose,     // [x,y,z,qw,qx,qy,qz]: at most `high` metres from the origin, quaternion of length 1
  kObject,   // with `fields`
};

enum class Need : std::uint8_t { kRequired, kOptional, kOrNull, kFallback };

constexpr double kBiggestWhole = 9007199254740992.0;  // 2^53: a double holds every whole number up to it

using Words = std::span<const char* const>;

// One field. Its functions return it changed, so that a row reads like a sentence.
struct RequestField {
  const char* name = "";
  FieldType type = FieldType::kNumber;
  const char* doc = "";  // what it means; the unit stands in the name, the range in the table
  Bound low{}, high{};
  Words words{};
  std::span<const RequestField> fields{};
  Need need = Need::kRequired;
  Bound fallback{};        // what it is when left out
  std::uint16_t most = 0;  // a list of so many; 0: a single value
  Arms arms = kEveryArm;

  // May be left out; without a value then, or an empty list.
  constexpr RequestField optional() const {
    RequestField out = *this;
    out.need = Need::kOptional;
    return out;
  }
  // May be left out or null.
  constexpr RequestField or_null() const {
    RequestField out = *this;
    out.need = Need::kOrNull;
    return out;
  }
  // May be left out; is `value` then.
  constexpr RequestField otherwise(Bound value) const {
    RequestField out = *this;
    out.need = Need::kFallback;
    out.fallback = value;
    return out;
  }
  // A list of at most so many such values.
  constexpr RequestField list(std::uint16_t entries) const {
    RequestField out = *this;
    out.most = entries;
    return out;
  }
  constexpr RequestField only_for(Arms kinds) const {
    RequestField out = *this;
    out.arms = kinds;
    return out;
  }
};

// What a request does to the motion that is under way.
enum class Motion : std::uint8_t {
  kNone,      // nothing that a stream of tip goals has to know
  kReplaces,  // ends a stream of tip goals
  kStreams,   // is one of a stream of tip goals: its jumps are bounded, and its time to live is watched
};

// How far the goal of one kStreams request may be from the one before: as far as the tip comes in this time at its
// limits.
constexpr double kJump_s = 0.5;

// One operation.
struct RequestRow {
  const char* op = "";
  const char* doc = "";  // one sentence
  std::span<const RequestField> fields{};
  Roles roles = kAnyRole;
  bool owner_only = false;
  Arms arms = kEveryArm;
  bool in_missions = false;  // a command of `arm`
  Motion motion = Motion::kNone;
  bool never_refused = false;  // its fields are taken as they come
};

// All of them, in the order of docs/reference/api.md.
std::span<const RequestRow> request_table();

// The row of an operation, or nullptr.
const RequestRow* find_request(std::string_view op);

// The present name of an operation or field that had another one before; else empty.
std::string_view present_op(std::string_view op);
std::string_view present_field(std::string_view field);

}  // namespace liana::api
