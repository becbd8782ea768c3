// What a request has asked for, once the table has let it through.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/api/server/request_table.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::api {

// The seven numbers of a pose.
Pose pose_of(const Json& numbers);

// Fields of a request, or of an object in it, that have passed check_fields; refers to all it is made of. Every
// function throws std::logic_error for a field that is not in the table, or was left out and has no default.
class Arguments {
 public:
  Arguments(const Json& object, std::span<const RequestField> fields, const RequestBounds& bounds)
      : object_(object), fields_(fields), bounds_(bounds) {}

  // It was given, and is not null.
  bool has(std::string_view name) const { return given(name) != nullptr; }
  double number(std::string_view name) const;
  std::int64_t integer(std::string_view name) const { return static_cast<std::int64_t>(number(name)); }
  bool flag(std::string_view name) const { return number(name) >= 0.5; }
  std::string text(std::string_view name) const;
  std::vector<double> numbers(std::string_view name) const;
  Vec3 point(std::string_view name) const;
  Pose pose(std::string_view name) const;
  Arguments object(std::string_view name) const;
  // Entries of a list; none when it was left out.
  std::vector<Arguments> entries(std::string_view name) const;
  std::vector<std::string> texts(std::string_view name) const;
  // As it came.
  const Json& json() const { return object_; }

 private:
  const RequestField& field(std::string_view name) const;
  const Json* given(std::string_view name) const;
  const Json& value(std::string_view name) const;

  const Json& object_;
  std::span<const RequestField> fields_;
  const RequestBounds& bounds_;
};

}  // namespace liana::api
