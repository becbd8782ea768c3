// Which pieces of a serial arm can touch one another, and how near they are.
#pragma once

#include <optional>
#include <vector>

#include "host/model/clearance/self_clearance.hpp"
#include "host/model/simulation/serial_chain.hpp"

namespace liana::simulation {

// Pieces with less axis between them than twice their thickness are as near as the joints between them are: what ranges
// of joints allow there is not looked at. All others count, with those of the arm that this one stands on.
constexpr double kDiametersBetween = 2.0;

class SerialContact {
 public:
  // `carried`: what the arm may have on its tip.
  explicit SerialContact(const SerialModel& model, const std::optional<CarriedBody>& carried = {});

  // The least distance at one pose, with what it may carry on the tip, or without: `link` is of this arm, `other` too;
  // joint_count is what it carries, and from there on those of the arm below; all 0-based. About 150 instructions for
  // each of the pairs that count.
  clearance::SelfClearance least(const SerialAxis& axis, bool carries = false) const;

  std::size_t pairs() const { return pairs_.size(); }

  // "link 3", "the payload", "link 2 of macro".
  std::string link_name(std::int32_t link) const;

 private:
  // `piece` is of this arm, one more than it has is what it carries; `other` is of this arm, too, or that of the base
  // where it is `of_base`.
  struct Pair {
    std::size_t piece, other;
    bool of_base;
  };

  void add_pairs(std::size_t piece, const std::vector<double>& length_m, double radius_m, std::vector<Pair>& out) const;
  double between_m(const SerialAxis& axis, const Pair& pair) const;
  clearance::Capsule piece_at(const SerialAxis& axis, std::size_t piece) const;
  std::int32_t number_of_base(std::size_t piece) const;

  SerialModel model_;
  std::optional<CarriedBody> carried_;
  std::vector<Pair> pairs_, pairs_carrying_;  // the second: of what is carried
};

}  // namespace liana::simulation
