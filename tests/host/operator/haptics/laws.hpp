// Every feedback law, for the tests that try them in turn.
#pragma once

#include <array>

#include "host/operator/haptics/feedback_law.hpp"

namespace liana::haptics {

constexpr std::array kLaws{Law::kClaim, Law::kAbstract, Law::kAligned};

}  // namespace liana::haptics
