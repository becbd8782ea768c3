#include "host/api/telemetry/record.hpp"

#include <bit>
#include <cstring>
#include <limits>
#include <string_view>

#include "host/base/json/json.hpp"

namespace liana::telemetry {
namespace {

static_assert(std::endian::native == std::endian::little, "records are little-endian");
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

template <class T>
void put(std::string& record, std::size_t offset, T value) {
  std::memcpy(record.data() + offset, &value, sizeof value);
}

template <class T>
T get(const std::string& record, std::size_t offset) {
  T value;
  std::memcpy(&value, record.data() + offset, sizeof value);
  return value;
}

float number(const Json& value) { return value.is_number() ? value.get<float>() : kMissing; }

// Values of one place, one after the other; those beyond its count are left out.
class Cells {
 public:
  Cells(std::string& record, const Place& place) : record_(record), offset_(place.offset), left_(place.count) {}
  void add(const Json& value) {
    if (value.is_array()) {
      for (const Json& each : value) add(each);
    } else if (left_ > 0) {
      put(record_, offset_, number(value));
      offset_ += sizeof(float);
      --left_;
    }
  }
  void fill() {
    while (left_ > 0) add(Json());
  }

 private:
  std::string& record_;
  std::size_t offset_, left_;
};

// The member that a path leads to; null where one on the way is not there.
const Json& at_path(const Json& json, std::string_view path) {
  const std::size_t dot = path.find('.');
  const Json& first = json.member_or_null(path.substr(0, dot));
  return dot == std::string_view::npos ? first : at_path(first, path.substr(dot + 1));
}

void encode(std::string& record, const Json& state, const Place& place) {
  Cells cells(record, place);
  if (place.field.shape == Shape::kEach) {
    const std::size_t dot = place.field.path.find('.');
    for (const Json& entry : state.member_or_null(place.field.path.substr(0, dot)))
      cells.add(entry.member_or_null(place.field.path.substr(dot + 1)));
  } else {
    cells.add(at_path(state, place.field.path));
  }
  cells.fill();
}

// Takes the member away that a path leads to, where it is there; of an array from each of its entries.
void erase(Json& json, std::string_view path) {
  if (json.is_array()) {
    for (Json& entry : json) erase(entry, path);
    return;
  }
  if (!json.is_object()) return;
  const std::size_t dot = path.find('.');
  if (dot == std::string_view::npos) return json.erase(path);
  if (Json* first = json.find(path.substr(0, dot))) erase(*first, path.substr(dot + 1));
}

}  // namespace

std::string encode(const Layout& layout, const Json& state, std::uint32_t sequence, std::uint32_t facts) {
  std::string record(layout.bytes, '\0');
  put(record, 0, sequence);
  put(record, 4, facts);
  put(record, 8, state.value("tick", 0.0));
  put(record, 16, state.value("time_s", 0.0));
  for (const Place& place : layout.places) encode(record, state, place);
  return record;
}

void set_facts(std::string& record, std::uint32_t facts) { put(record, 4, facts); }

Header header_of(const std::string& record) {
  return {get<std::uint32_t>(record, 0), get<std::uint32_t>(record, 4), get<double>(record, 8),
          get<double>(record, 16)};
}

float value_of(const std::string& record, const Place& place, std::size_t i) {
  return get<float>(record, place.offset + i * sizeof(float));
}

Json facts_of(Json state) {
  const Json* verdict = state.find("verdict");
  if (verdict != nullptr && verdict->value("code", 0) == 0) state.erase("verdict");
  for (const Field& field : kFields) erase(state, field.path);
  if (Json* drives = state.find("drives"); drives != nullptr && drives->is_array()) {
    for (Json& drive : *drives) {
      drive.erase("tension_N");  // what the arm has as a whole, again
      drive.erase("torque_Nm");
    }
  }
  for (const char* own : {"op", "tick", "time_s", "events"}) state.erase(own);
  return state;
}

}  // namespace liana::telemetry
