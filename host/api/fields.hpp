// Checked reading of request fields; every function throws RequestError naming field, value and allowed range.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/json/json_fwd.hpp"

namespace liana {

// Refuses (`bad_request`) the first key of an object that is not among `allowed`: a misspelt optional field must not
// pass unseen.
void only_fields(const Json& object, const std::vector<std::string>& allowed);
// A number in [min, max]: `bad_request` when missing or no number, `out_of_range` outside.
double number_field(const Json& object, const std::string& key, double min, double max);
// The same, or `fallback` when the key is missing.
double number_field_or(const Json& object, const std::string& key, double min, double max, double fallback);
// A whole number in [min, max].
std::int64_t integer_field(const Json& object, const std::string& key, std::int64_t min, std::int64_t max);
// An array of exactly `count` numbers, each in [min, max].
std::vector<double> numbers_field(const Json& object, const std::string& key, std::size_t count, double min,
                                  double max);
// A point in metres, each coordinate within +-reach_m.
Vec3 point_field(const Json& object, const std::string& key, double reach_m);
// [x,y,z,qw,qx,qy,qz]: coordinates within +-reach_m, quaternion of unit length to 1e-6.
Pose pose_field(const Json& object, const std::string& key, double reach_m);
// A text of 1 to max_bytes bytes.
std::string text_field(const Json& object, const std::string& key, std::size_t max_bytes);
// true or false (also 1 or 0).
bool flag_field(const Json& object, const std::string& key);
// The array under `key`, at most `max_items` long; empty when the key is missing.
const Json& array_field(const Json& object, const std::string& key, std::size_t max_items);
// Gives every entry of that array, with its index from 0, to `read`; what it refuses names the entry: "entry 2 of
// nodes: ...".
void read_entries(const Json& object, const std::string& key, std::size_t max_items,
                  const std::function<void(std::size_t, const Json&)>& read);

}  // namespace liana
