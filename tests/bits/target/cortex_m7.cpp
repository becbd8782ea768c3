// The Cortex-M7's meter: instructions of each tick, and how deep its stack goes.
#include <cstdint>
#include <cstdio>

#include "tests/bits/tape.hpp"
#include "tests/bits/target/meter.hpp"

extern "C" void initialise_monitor_handles();  // librdimon: files of the host

namespace liana::bits {
namespace {

constexpr std::uint32_t kCounterMask = 0xFFFFFF;  // SysTick counts down through 24 bits
constexpr std::uint32_t kPaint = 0xC0DEFEED;
constexpr std::uint32_t kWatchedWords = 8192;  // 32 KiB of stack below the caller of tick

struct SysTick {
  volatile std::uint32_t control, reload, value, calibration;
};
SysTick* const sys_tick = reinterpret_cast<SysTick*>(0xE000E010);

std::FILE* meter = nullptr;  // what is written there is checked when it is closed

std::uint32_t clocks_since(std::uint32_t before) noexcept { return (before - sys_tick->value) & kCounterMask; }

// Clocks of a loop of two instructions a round: they show how many instructions a clock stands for.
std::uint32_t calibration_clocks() noexcept {
  std::uint32_t rounds = kCalibrationInstructions / 2;
  const std::uint32_t before = sys_tick->value;
  asm volatile("1: subs %0, #1\n bne 1b" : "+r"(rounds) : : "cc");
  return clocks_since(before);
}

void write(const Count& count) noexcept {
  if (meter != nullptr) std::fwrite(&count, sizeof count, 1, meter);
}

// Before main: opens the way to the host's files, and starts the counter.
struct Start {
  Start() {
    initialise_monitor_handles();
    sys_tick->reload = kCounterMask;
    sys_tick->value = 0;
    sys_tick->control = 5;  // on, processor clock, no interrupt
    meter = std::fopen(kMeterFile, "wb");
    write({calibration_clocks(), 0});
  }
} start;

}  // namespace

template <class Arm>
__attribute__((noinline)) Outputs<Arm> metered_tick(Controller<Arm>& controller, const Inputs<Arm>& inputs) noexcept {
  volatile std::uint32_t* stack_pointer = nullptr;
  asm volatile("mov %0, sp" : "=r"(stack_pointer));
  volatile std::uint32_t* lowest = stack_pointer - kWatchedWords;
  for (volatile std::uint32_t* word = lowest; word != stack_pointer; ++word) *word = kPaint;
  const std::uint32_t before = sys_tick->value;
  const Outputs<Arm> outputs = controller.tick(inputs);
  const std::uint32_t clocks = clocks_since(before);
  while (*lowest == kPaint) ++lowest;
  write({clocks, static_cast<std::uint32_t>(stack_pointer - lowest) * sizeof(std::uint32_t)});
  return outputs;
}

template Outputs<cable::CableArm> metered_tick(cable::Controller&, const cable::Inputs&) noexcept;
template Outputs<serial::SerialArm> metered_tick(serial::Controller&, const serial::Inputs&) noexcept;

bool close_meter() { return meter != nullptr && std::ferror(meter) == 0 && std::fclose(meter) == 0; }

}  // namespace liana::bits
