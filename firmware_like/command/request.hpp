// What an operator or client asks of the state machine.
#pragma once

#include <cstdint>

namespace liana {

// Acts on the tick that carries it. kRecover clears as kClear does, but the arm stays without the cable that it has
// lost: what is enabled after that only goes back along its path.
enum class Request : std::uint8_t { kNone = 0, kEnable = 1, kDisable = 2, kClear = 3, kStop = 4, kRecover = 5 };

}  // namespace liana
