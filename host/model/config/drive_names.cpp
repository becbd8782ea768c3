#include "host/model/config/drive_names.hpp"

#include "firmware_like/cable/arm/cables.hpp"

namespace liana::config {
std::string drive_text(std::size_t drive, DrivePlace place, int segment) {
  const std::string axis = place.axis > 1 ? ", axis " + std::to_string(place.axis) : "";
  const std::string where = segment > 0 ? ", segment " + std::to_string(segment) : "";
  return "drive " + std::to_string(drive + 1) + " (node " + std::to_string(place.node) + axis + where + ")";
}

DriveNames::DriveNames(const cable::RobotParams& table, std::vector<DrivePlace> places)
    : places_(std::move(places)), feed_count_(static_cast<std::size_t>(table.feed_count())) {
  const cable::CableLayout layout = cable::cable_layout(table);
  for (std::size_t c = 0; c < static_cast<std::size_t>(layout.cable_count); ++c)
    segments_.push_back(layout.segment[c] + 1);
}

std::string DriveNames::cable(std::size_t cable) const {
  if (cable < feed_count_) return cable == 0 ? "slide" : "roll";
  return "cable " + std::to_string(cable + 1) + " (segment " + std::to_string(segment_of(cable)) + ")";
}

}  // namespace liana::config
