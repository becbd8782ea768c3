// What lianad is to be told of a full disk, on its way from the thread that writes to the one that speaks.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "host/base/json/json.hpp"

namespace liana::archive {

class Alarms {
 public:
  // So many wait at once; of more the counts alone are added to the last. A long text is cut.
  static constexpr std::size_t kMost = 8;

  void add(const std::string& text, std::uint64_t count);
  // The oldest as a request (`archive_alarm`, docs/reference/api.md); nothing when none waits.
  std::optional<Json> take();

 private:
  struct Alarm {
    std::string text;
    std::uint64_t count = 0;
  };
  std::mutex mutex_;
  std::deque<Alarm> waiting_;
};

}  // namespace liana::archive
