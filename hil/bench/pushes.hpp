// What pushes the arm in a slot, by its fault list.
#pragma once

#include <string>
#include <vector>

#include "hil/arm/contact_forces.hpp"
#include "hil/bench/fault_injector.hpp"

namespace liana::bench {

// The pushes of this slot on an arm of `links` links; each grows and falls evenly over its `slots`.
std::vector<Push> pushes_at(std::uint32_t slot, const FaultInjector& injector, std::size_t links);

// Throws std::runtime_error when a push is on a link that the arm does not have, or `arm` is a model without body.
void check_pushes(const std::vector<FaultConfig>& faults, std::size_t links, const std::string& arm);

}  // namespace liana::bench
