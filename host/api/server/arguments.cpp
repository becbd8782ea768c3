#include "host/api/server/arguments.hpp"

#include <algorithm>
#include <stdexcept>

#include "host/base/json/json.hpp"

namespace liana::api {

Pose pose_of(const Json& numbers) {
  const auto p = numbers.get<std::array<double, 7>>();
  return {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}};
}

const RequestField& Arguments::field(std::string_view name) const {
  const auto found =
      std::find_if(fields_.begin(), fields_.end(), [name](const RequestField& f) { return name == f.name; });
  if (found == fields_.end()) throw std::logic_error("no field " + std::string(name) + " in the table of requests");
  return *found;
}

const Json* Arguments::given(std::string_view name) const {
  const Json* value = object_.find(field(name).name);
  return value != nullptr && value->is_null() ? nullptr : value;
}

const Json& Arguments::value(std::string_view name) const {
  if (const Json* value = given(name)) return *value;
  throw std::logic_error("field " + std::string(name) + " was left out");
}

double Arguments::number(std::string_view name) const {
  const Json* value = given(name);
  if (value == nullptr && field(name).need == Need::kFallback) return bounds_.value_of(field(name).fallback);
  const Json& number = this->value(name);
  return number.is_boolean() ? static_cast<double>(number.get<bool>()) : number.get<double>();
}

std::string Arguments::text(std::string_view name) const { return value(name).text(); }
std::vector<double> Arguments::numbers(std::string_view name) const { return value(name).get<std::vector<double>>(); }
Vec3 Arguments::point(std::string_view name) const { return value(name).get<Vec3>(); }
Pose Arguments::pose(std::string_view name) const { return pose_of(value(name)); }
Arguments Arguments::object(std::string_view name) const { return {value(name), field(name).fields, bounds_}; }

std::vector<Arguments> Arguments::entries(std::string_view name) const {
  std::vector<Arguments> out;
  if (!has(name)) return out;
  for (const Json& entry : value(name)) out.emplace_back(entry, field(name).fields, bounds_);
  return out;
}

std::vector<std::string> Arguments::texts(std::string_view name) const {
  return has(name) ? value(name).get<std::vector<std::string>>() : std::vector<std::string>();
}

}  // namespace liana::api
