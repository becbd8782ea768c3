// Messages on their way from the one who reads them to the one who writes: a disk may take half a second for a commit,
// and lianad is answered meanwhile.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "host/base/json/json.hpp"

namespace liana::archive {

class Inbox {
 public:
  // As many as 5 s bring, with 20 kB each. Who puts in more waits.
  static constexpr std::size_t kMost = 256;

  struct Letter {
    std::string packet;  // as it came
    Json message;        // null for a packet that is no JSON
  };

  explicit Inbox(std::size_t most = kMost) : most_(most) {}

  // Waits while it is full; what comes after close() is thrown away.
  void put(Letter letter);
  // Does not wait: false where it is full, and the letter is thrown away.
  bool try_put(Letter letter);
  // Waits for one, and a moment for those that follow it; nothing after close(), when all have been taken.
  std::optional<Letter> take();
  // Nobody waits any more.
  void close();
  bool is_closed();

 private:
  static constexpr std::chrono::milliseconds kGather{20};
  std::size_t enough() const { return std::min<std::size_t>(most_, 64); }
  void add(Letter letter);
  void gather(std::unique_lock<std::mutex>& lock);

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Letter> letters_;
  bool closed_ = false;
};

}  // namespace liana::archive
