// What the Cortex-M7 counted, tick by tick.
#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace liana::bits {

struct MeterSummary {
  std::uint64_t ticks = 0;
  double median_instructions = 0.0;  // over the ticks with the arm enabled
  double worst_instructions = 0.0;   // over all ticks
  std::uint64_t worst_tick = 0;      // Outputs::tick of it
  std::string worst_state;           // operating state of it
  std::uint32_t worst_stack_bytes = 0;
};

// `outputs` as the target wrote them, of this kind of arm, `meter` beside it. Throws std::runtime_error when the files
// do not belong together, or the counter did not count instructions.
template <class Arm>
MeterSummary summarise(std::istream& outputs, std::istream& meter);

}  // namespace liana::bits
