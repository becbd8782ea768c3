// What the real-time thread needs from the machine, and clear words when it does not get it.
#pragma once

#include <functional>
#include <stop_token>
#include <thread>

#include "host/control/realtime/last_stop.hpp"

namespace liana::realtime {

constexpr int kRealtimePriority = 80;  // over drivers' interrupt threads (50), under the kernel's own watchdogs (99)

// Locks all memory, present and future, and gives threads that start later stacks of 1 MiB. Throws std::runtime_error
// naming the missing privilege.
void lock_memory();

// From now on this thread and those that it starts come before ordinary work of the machine, so that the verdict on the
// next command is not late for want of a processor. They share it all the same: a long search starves nobody. Where the
// machine does not grant it nothing changes.
void come_before_ordinary_work();

// Starts `body` in a thread with SCHED_FIFO and a stack that is already in memory. How it ends is written to `end`,
// which must outlive the thread. Throws std::runtime_error naming the missing privilege.
std::jthread start_realtime(std::function<void(const std::stop_token&)> body, ThreadResult& end);

}  // namespace liana::realtime
