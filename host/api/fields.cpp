#include "host/api/fields.hpp"

#include <algorithm>

#include "host/api/request_error.hpp"
#include "host/json/json.hpp"

namespace liana {

namespace {

std::string text_of(double value) { return Json(value).dump(); }

// The unit that a name ends in: " deg/s" of rate_deg_s, " m" of position_m[2]; empty without one.
std::string unit_of(const std::string& name) {
  const std::string stem = name.substr(0, name.find('['));
  if (stem.ends_with("_deg_s")) return " deg/s";
  if (stem.ends_with("_m_s")) return " m/s";
  if (stem.ends_with("_deg")) return " deg";
  return stem.ends_with("_m") ? " m" : "";
}

const Json& field(const Json& object, const std::string& key) {
  if (!object.is_object()) {
    throw RequestError("bad_request", "field '" + key + "' is missing: found " + object.dump().substr(0, 60) +
                                          " where an object with this field belongs");
  }
  const auto found = object.find(key);
  if (found == object.end()) throw RequestError("bad_request", "field '" + key + "' is missing: add it");
  return *found;
}

double checked_number(const Json& value, const std::string& name, double min, double max) {
  if (!value.is_number())
    throw RequestError("bad_request", "field '" + name + "': " + value.dump().substr(0, 60) + ": must be a number");
  const double number = value.get<double>();
  if (!(number >= min && number <= max)) {
    throw RequestError("out_of_range", name + " = " + text_of(number) + ": allowed " + text_of(min) + " to " +
                                           text_of(max) + unit_of(name));
  }
  return number;
}

}  // namespace

void only_fields(const Json& object, const std::vector<std::string>& allowed) {
  if (!object.is_object()) return;  // the reading of a field says so
  for (const auto& [key, value] : object.items()) {
    if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
    std::string names;
    for (const std::string& name : allowed) names += (names.empty() ? "" : ", ") + name;
    throw RequestError("bad_request", "field '" + key + "' is not known: allowed " + names + ": correct or remove it");
  }
}

double number_field(const Json& object, const std::string& key, double min, double max) {
  return checked_number(field(object, key), key, min, max);
}

double number_field_or(const Json& object, const std::string& key, double min, double max, double fallback) {
  return object.contains(key) ? number_field(object, key, min, max) : fallback;
}

std::int64_t integer_field(const Json& object, const std::string& key, std::int64_t min, std::int64_t max) {
  const Json& value = field(object, key);
  if (!value.is_number_integer())
    throw RequestError("bad_request",
                       "field '" + key + "': " + value.dump().substr(0, 60) + ": must be a whole number");
  checked_number(value, key, static_cast<double>(min), static_cast<double>(max));
  return value.get<std::int64_t>();
}

std::vector<double> numbers_field(const Json& object, const std::string& key, std::size_t count, double min,
                                  double max) {
  const Json& value = field(object, key);
  if (!value.is_array() || value.size() != count) {
    const std::string found = value.is_array() ? std::to_string(value.size()) + " entries" : value.dump().substr(0, 60);
    throw RequestError("bad_request",
                       "field '" + key + "': " + found + ": must be an array of " + std::to_string(count) + " numbers");
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(checked_number(value[i], key + "[" + std::to_string(i) + "]", min, max));
  }
  return numbers;
}

Vec3 point_field(const Json& object, const std::string& key, double reach_m) {
  const std::vector<double> p = numbers_field(object, key, 3, -reach_m, reach_m);
  return {p[0], p[1], p[2]};
}

Pose pose_field(const Json& object, const std::string& key, double reach_m) {
  const std::vector<double> p = numbers_field(object, key, 7, -std::max(reach_m, 1.001), std::max(reach_m, 1.001));
  Pose pose{{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}};
  if (!is_valid(pose))
    throw RequestError("out_of_range", key + ": the quaternion (qw,qx,qy,qz) must have length 1 within 1e-6");
  if (norm(pose.position_m) > reach_m) {
    throw RequestError("out_of_range", key + ": " + text_of(norm(pose.position_m)) +
                                           " m from the base; the arm reaches " + text_of(reach_m) + " m");
  }
  return pose;
}

std::string text_field(const Json& object, const std::string& key, std::size_t max_bytes) {
  const Json& value = field(object, key);
  const bool good = value.is_string() && !value.get_ref<const std::string&>().empty() &&
                    value.get_ref<const std::string&>().size() <= max_bytes;
  if (!good)
    throw RequestError("bad_request",
                       "field '" + key + "': must be a text of 1 to " + std::to_string(max_bytes) + " bytes");
  return value.get<std::string>();
}

bool flag_field(const Json& object, const std::string& key) {
  const Json& value = field(object, key);
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>() >= 0.5;
  throw RequestError("bad_request", "field '" + key + "': must be true or false");
}

const Json& array_field(const Json& object, const std::string& key, std::size_t max_items) {
  static const Json kEmpty = Json::array();
  const auto found = object.find(key);
  if (found == object.end()) return kEmpty;
  if (!found->is_array() || found->size() > max_items) {
    const std::string what =
        found->is_array() ? std::to_string(found->size()) + " entries" : found->dump().substr(0, 60);
    throw RequestError("bad_request", "field '" + key + "': " + what + ": must be an array of at most " +
                                          std::to_string(max_items) + " entries");
  }
  return *found;
}

void read_entries(const Json& object, const std::string& key, std::size_t max_items,
                  const std::function<void(std::size_t, const Json&)>& read) {
  const Json& entries = array_field(object, key, max_items);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    try {
      read(i, entries[i]);
    } catch (const RequestError& error) {
      throw RequestError(error.code(), "entry " + std::to_string(i + 1) + " of " + key + ": " + error.what());
    }
  }
}

}  // namespace liana
