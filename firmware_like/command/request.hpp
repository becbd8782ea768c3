// What an operator or client asks of the state machine.
#pragma once

#include <cstdint>

namespace liana {

// Acts on the tick that carries it.
enum class Request : std::uint8_t { kNone = 0, kEnable = 1, kDisable = 2, kClear = 3, kStop = 4 };

}  // namespace liana
