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
    if (std::find(out.begin(), out.end(), serial) != out.end())
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

void check_nodes(const std::string& robot, std::int32_t drives, const std::string& file, const BusesConfig& buses) {
  const std::string allowed =
      ": allowed the nodes 1 to " + std::to_string(drives) + " of robot " + robot + ", each on one bus: ";
  for (std::int32_t node = 1; node <= drives; ++node) {
    if (buses.bus_of_node(node) < 0) {
      throw std::runtime_error(file + ": buses " + buses.name + ": " + drive_text(static_cast<std::size_t>(node - 1)) +
                               " is on no bus" + allowed + "add it to a bus");
    }
  }
  for (const BusConfig& bus : buses.buses) {
    for (const std::int32_t node : bus.nodes) {
      if (node <= drives) continue;
      throw std::runtime_error(file + ": buses " + buses.name + ": node " + std::to_string(node) + allowed +
                               "remove it from bus " + bus.name);
    }
  }
}

}  // namespace liana::config
