// What the real-time thread needs from the machine, and clear words when it does not get it.
#pragma once

#include <functional>
#include <thread>

namespace liana {

constexpr int kRealtimePriority = 80;  // over drivers' interrupt threads (50), under the kernel's own watchdogs (99)

// Locks all memory, present and future. Throws std::runtime_error naming the missing privilege.
void lock_memory();

// Starts `body` in a thread with SCHED_FIFO and a stack that is already in memory. Throws std::runtime_error naming the
// missing privilege.
std::thread start_realtime(std::function<void()> body);

}  // namespace liana
