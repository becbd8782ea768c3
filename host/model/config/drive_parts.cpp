// What the drives of every kind of robot have in their table, and that each is on a bus.
#include <algorithm>
#include <stdexcept>

#include "host/model/config/drive_names.hpp"
#include "host/model/config/robot_parts.hpp"

namespace liana::config {

DriveIdentity read_identity(const Field& field) {
  field.only({"vendor", "product", "revision"});
  constexpr std::int64_t kMaxU32 = 0xffffffff;
  return {static_cast<std::uint32_t>(field.at("vendor").integer(0, kMaxU32)),
          static_cast<std::uint32_t>(field.at("product").integer(0, kMaxU32)),
          static_cast<std::uint32_t>(field.at("revision").integer(0, kMaxU32))};
}

std::vector<std::uint32_t> read_serials(const Field& drives, std::size_t count) {
  std::vector<std::uint32_t> out;
  if (!drives.json().contains("serials")) return out;
  const Field serials = drives.at("serials");
  serials.size(count, count, "one entry per drive, that of node 1 first");
  for (std::size_t i = 0; i < count; ++i) {
    const auto serial = static_cast<std::uint32_t>(serials.element(i).integer(1, 0xffffffff));
    const bool is_next_axis = i > 0 && out.back() == serial;  // check_nodes knows the buses
    if (!is_next_axis && std::find(out.begin(), out.end(), serial) != out.end())
      serials.element(i).refuse("a number that no other drive has",
                                "look at the drive's plate, or leave drives.serials out");
    out.push_back(serial);
  }
  return out;
}

std::int32_t read_calibration_days(const Field& drives) {
  constexpr std::int32_t kCalibrationDays = 365;
  if (!drives.json().contains("calibration_days")) return kCalibrationDays;
  return static_cast<std::int32_t>(drives.at("calibration_days").integer(1, 36500));
}

namespace {

// The axes of one node have its one serial number, other drives each their own.
void check_serials(const std::vector<std::uint32_t>& serials, const std::vector<DrivePlace>& places,
                   const std::string& file) {
  for (std::size_t i = 1; i < serials.size(); ++i) {
    const bool is_same_node = places[i].node == places[i - 1].node;
    if (is_same_node == (serials[i] == serials[i - 1])) continue;
    throw std::runtime_error(file + ": drives.serials[" + std::to_string(i + 1) + "]: " + std::to_string(serials[i]) +
                             ": allowed " +
                             (is_same_node ? std::to_string(serials[i - 1]) + ", that of the node's axis 1"
                                           : "a number that no other node has") +
                             ": look at the drive's plate, or leave drives.serials out");
  }
}

}  // namespace

void check_nodes(const std::string& robot, std::int32_t drives, const std::vector<std::uint32_t>& serials,
                 const std::string& file, const BusesConfig& buses) {
  const std::string allowed =
      ": allowed " + std::to_string(drives) + " drives for robot " + robot + ", on nodes from 1 without a gap: ";
  const std::vector<DrivePlace> places = buses.places();
  const auto count = static_cast<std::size_t>(drives);
  std::int32_t next = 1;  // node that is due
  for (std::size_t i = 0; i < count; ++i) {
    if (i == places.size() || places[i].node > next)
      throw std::runtime_error(file + ": buses " + buses.name + ": " + drive_text(i, next) + " is on no bus" + allowed +
                               "add it to a bus");
    next = places[i].node + 1;
  }
  if (places.size() > count)
    throw std::runtime_error(file + ": buses " + buses.name + ": node " + std::to_string(places[count].node) + allowed +
                             "remove it from its bus");
  check_serials(serials, places, file);
}

}  // namespace liana::config
