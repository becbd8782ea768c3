// Which pieces of a serial arm can touch one another, and how near they are.
#pragma once

#include <vector>

#include "host/clearance/self_clearance.hpp"
#include "host/simulate/serial_chain.hpp"

namespace liana::simulate {

// Pieces with less axis between them than twice their thickness are as near as the joints between them are: what ranges
// of joints allow there is not looked at. All others count, with those of the arm that this one stands on.
constexpr double kDiametersBetween = 2.0;

class SerialContact {
 public:
  explicit SerialContact(const SerialModel& model);

  // The least distance at one pose: `link` is of this arm, `other` too, or of the arm below when it is
  // joint_count or more; both 0-based. About 150 instructions for each of the pairs that count.
  clearance::SelfClearance least(const SerialAxis& axis) const;

  std::size_t pairs() const { return pairs_.size(); }

  // "link 3", "link 2 of macro".
  std::string link_name(std::int32_t link) const;

 private:
  // `piece` is of this arm; `other` too, or that of the base where it is `of_base`.
  struct Pair {
    std::size_t piece, other;
    bool of_base;
  };

  SerialModel model_;
  std::vector<Pair> pairs_;
};

}  // namespace liana::simulate
