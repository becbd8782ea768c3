#include "tests/bits/meter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/serialise.hpp"
#include "tests/bits/tape.hpp"

namespace liana::bits {
namespace {

std::string next_of(std::istream& file, std::size_t size) {
  std::string bytes(size, '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size)) && file.gcount() != 0)
    throw std::runtime_error("meter: a file ends early");
  return file ? bytes : std::string();
}

Count count_from(const std::string& bytes) {
  Count count{};
  recording::Reader reader(bytes);
  reader("clocks", count.clocks);
  reader("stack_bytes", count.stack_bytes);
  return count;
}

const char* name_of(OperatingState state) {
  constexpr std::array<const char*, 5> kNames{"disabled", "enabling", "enabled", "stopping", "fault"};
  return kNames.at(static_cast<std::size_t>(state));
}

// Instructions per clock, from a loop of known length. Under -icount every instruction takes equally long, so this is
// the same on every machine.
double instructions_per_clock(const std::string& bytes) {
  const std::uint32_t clocks = bytes.empty() ? 0 : count_from(bytes).clocks;
  const double ratio = clocks == 0 ? 0.0 : static_cast<double>(kCalibrationInstructions) / clocks;
  constexpr double kOneIn1_25 = 1.25;  // QEMU -icount shift=5: 32 ns an instruction; SysTick: 40 ns
  if (!(std::fabs(ratio - kOneIn1_25) < 0.01))
    throw std::runtime_error("meter: the clock counts no instructions; QEMU needs -icount shift=5");
  return kOneIn1_25;
}

}  // namespace

template <class Arm>
MeterSummary summarise(std::istream& outputs, std::istream& meter) {
  MeterSummary result;
  const double per_clock = instructions_per_clock(next_of(meter, sizeof(Count)));
  std::vector<double> enabled;
  for (;;) {
    const std::string answer = next_of(outputs, recording::serialised_outputs_size<Arm>()),
                      counted = next_of(meter, sizeof(Count));
    if (answer.empty() != counted.empty()) throw std::runtime_error("meter: not one count for each tick");
    if (answer.empty()) break;
    const Outputs<Arm> out = recording::outputs_from<Arm>(answer);
    const Count count = count_from(counted);
    const double instructions = per_clock * count.clocks;
    ++result.ticks;
    if (out.state == OperatingState::kEnabled) enabled.push_back(instructions);
    result.worst_stack_bytes = std::max(result.worst_stack_bytes, count.stack_bytes);
    if (instructions <= result.worst_instructions) continue;
    result.worst_instructions = instructions;
    result.worst_tick = out.tick;
    result.worst_state = name_of(out.state);
  }
  if (enabled.empty()) throw std::runtime_error("meter: the arm was never enabled");
  const auto middle = enabled.begin() + static_cast<std::ptrdiff_t>(enabled.size() / 2);
  std::nth_element(enabled.begin(), middle, enabled.end());
  result.median_instructions = *middle;
  return result;
}

template MeterSummary summarise<cable::CableArm>(std::istream&, std::istream&);
template MeterSummary summarise<serial::SerialArm>(std::istream&, std::istream&);

}  // namespace liana::bits
