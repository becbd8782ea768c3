#include "host/simulate/serial_contact.hpp"

namespace liana::simulate {

namespace {

double length_of(const clearance::Capsule& piece) { return norm(subtract(piece.to_m, piece.from_m)); }

std::int32_t link_of(std::size_t piece) { return static_cast<std::int32_t>(piece) / kPiecesPerLink; }

}  // namespace

// Where every piece begins along the axis of both arms; their lengths are the same at all poses.
SerialContact::SerialContact(const SerialModel& model) : model_(model) {
  const SerialAxis axis = serial_axis(model.table, {});
  std::vector<double> length_m;
  for (const clearance::Capsule& piece : model.base) length_m.push_back(length_of(piece));
  for (std::size_t i = 0; i + 1 < axis.count; ++i)
    length_m.push_back(norm(subtract(axis.point_m[i + 1], axis.point_m[i])));
  const auto radius_m = [&](std::size_t piece) {
    return piece < model.base.size() ? model.base[piece].radius_m : model.link_radius_m;
  };
  for (std::size_t piece = model.base.size(); piece < length_m.size(); ++piece) {
    double between_m = 0.0;
    for (std::size_t other = piece; other-- > 0;) {
      const bool both_are = length_m[piece] > 0.0 && length_m[other] > 0.0;
      const bool of_base = other < model.base.size();
      const double diameters_m = kDiametersBetween * (radius_m(piece) + radius_m(other));
      if (both_are && between_m >= diameters_m)
        pairs_.push_back({piece - model.base.size(), of_base ? other : other - model.base.size(), of_base});
      between_m += length_m[other];
    }
  }
}

clearance::SelfClearance SerialContact::least(const SerialAxis& axis) const {
  clearance::SelfClearance out;
  for (const Pair& pair : pairs_) {
    const auto piece_of = [&](std::size_t piece) {
      return clearance::link_capsule(axis.points(), static_cast<std::int32_t>(piece), model_.link_radius_m);
    };
    const clearance::Capsule other = pair.of_base ? model_.base[pair.other] : piece_of(pair.other);
    const double distance_m = clearance::between_m(piece_of(pair.piece), other);
    if (distance_m >= out.nearest_m) continue;
    out = {distance_m, link_of(pair.piece),
           pair.of_base ? model_.table.joint_count + model_.base_of_link[pair.other] : link_of(pair.other)};
  }
  return out;
}

std::string SerialContact::link_name(std::int32_t link) const {
  const bool of_base = link >= model_.table.joint_count;
  const std::string number = std::to_string(1 + (of_base ? link - model_.table.joint_count : link));
  return "link " + number + (of_base ? " of " + model_.base_name : "");
}

}  // namespace liana::simulate
