#include "host/model/simulation/serial_contact.hpp"

#include <cmath>

namespace liana::simulation {

namespace {

double length_of(const clearance::Capsule& piece) { return norm(subtract(piece.to_m, piece.from_m)); }

std::int32_t link_of(std::size_t piece) { return static_cast<std::int32_t>(piece) / kPiecesPerLink; }

}  // namespace

// The lengths of the pieces along both arms are the same at all poses.
SerialContact::SerialContact(const SerialModel& model, const std::optional<CarriedBody>& carried)
    : model_(model), carried_(carried) {
  const SerialAxis axis = serial_axis(model.table, {});
  std::vector<double> length_m;
  const std::size_t below = model.base_of_link.size();
  for (std::size_t piece = 0; piece < below; ++piece) length_m.push_back(length_of(model.base[piece]));
  for (std::size_t i = 0; i + 1 < axis.count; ++i)
    length_m.push_back(norm(subtract(axis.point_m[i + 1], axis.point_m[i])));
  for (std::size_t piece = below; piece < length_m.size(); ++piece)
    if (length_m[piece] > 0.0) add_pairs(piece, length_m, model.link_radius_m, pairs_);
  if (carried) add_pairs(length_m.size(), length_m, carried->radius_m, pairs_carrying_);
}

// With all pieces before it that are far enough from it along the arm.
void SerialContact::add_pairs(std::size_t piece, const std::vector<double>& length_m, double radius_m,
                              std::vector<Pair>& out) const {
  const std::size_t below = model_.base_of_link.size();
  double between_m = 0.0;
  for (std::size_t other = piece; other-- > 0; between_m += length_m[other]) {
    const bool of_base = other < below;
    const double other_radius_m = of_base ? model_.base[other].radius_m : model_.link_radius_m;
    if (length_m[other] > 0.0 && between_m >= kDiametersBetween * (radius_m + other_radius_m))
      out.push_back({piece - below, of_base ? other : other - below, of_base});
  }
}

clearance::Capsule SerialContact::piece_at(const SerialAxis& axis, std::size_t piece) const {
  if (piece + 1 < axis.count)
    return clearance::link_capsule(axis.points(), static_cast<std::int32_t>(piece), model_.link_radius_m);
  return {axis.beyond_tip_m(carried_->from_m), axis.beyond_tip_m(carried_->to_m), carried_->radius_m};
}

clearance::SelfClearance SerialContact::least(const SerialAxis& axis, bool carries) const {
  clearance::SelfClearance out;
  const auto look_at = [&](const std::vector<Pair>& pairs) {
    for (const Pair& pair : pairs) {
      const double distance_m = between_m(axis, pair);
      if (distance_m >= out.nearest_m) continue;
      out = {distance_m, link_of(pair.piece), pair.of_base ? number_of_base(pair.other) : link_of(pair.other)};
    }
  };
  look_at(pairs_);
  if (carries) look_at(pairs_carrying_);
  return out;
}

// Of a link of the arm below the least of all places that it can be at.
double SerialContact::between_m(const SerialAxis& axis, const Pair& pair) const {
  const clearance::Capsule piece = piece_at(axis, pair.piece);
  if (!pair.of_base) return clearance::between_m(piece, piece_at(axis, pair.other));
  double least_m = clearance::kNoObstacle_m;
  for (std::size_t at = pair.other; at < model_.base.size(); at += model_.base_of_link.size())
    least_m = std::fmin(least_m, clearance::between_m(piece, model_.base[at]));
  return least_m;
}

std::int32_t SerialContact::number_of_base(std::size_t piece) const {
  return model_.table.joint_count + 1 + model_.base_of_link[piece];
}

std::string SerialContact::link_name(std::int32_t link) const {
  if (link == model_.table.joint_count) return "the payload";
  const bool of_base = link > model_.table.joint_count;
  const std::string number = std::to_string(1 + (of_base ? link - model_.table.joint_count - 1 : link));
  return "link " + number + (of_base ? " of " + model_.base_name : "");
}

}  // namespace liana::simulation
