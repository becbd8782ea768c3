// What the process that runs a script shows to the one that watches it, in memory both share.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string_view>

namespace liana::mission_runner {

// Shared between the watchdog and the script's process; the watchdog also reads it after the process is dead.
struct Activity {
  std::atomic<std::uint64_t> beats{0};  // grows whenever the script has given back control
  std::atomic<std::uint32_t> line{0};   // last line the count hook saw
  std::array<char, 128> file{};         // and its file
  std::atomic<std::uint64_t> tick{0};   // of the last state
  double period_s = 0.0;                // of a tick, written once before the first state
  std::array<char, 128> mission{};      // what runs
  std::array<char, 1 << 19> report{};   // last report, JSON

  void beat() { beats.fetch_add(1, std::memory_order_relaxed); }
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

// Copies as much of `text` as fits, zero-terminated; text that does not fit in whole is cut.
template <std::size_t N>
void put_text(std::array<char, N>& to, std::string_view text) {
  const std::size_t length = text.size() < N ? text.size() : N - 1;
  text.copy(to.data(), length);
  to[length] = '\0';
}

}  // namespace liana::mission_runner
