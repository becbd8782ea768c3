// One client's faults for a simulated arm: over a connection of its own to the bench's socket.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "host/apps/gateway/api_connection.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {

class Practice {
 public:
  static constexpr std::size_t kMaxOpen = 16;      // requests that the bench has not answered yet
  static constexpr std::size_t kMaxBytes = 60000;  // of a list of faults: the bench reads no longer ones

  // Gets an answer to the client: {"op":"answer","id":...,"ok":...}.
  using Answer = std::function<void(const Json& answer)>;

  // `bench`: socket of liana-bench --practice; empty: the arm is not simulated here. `poller` must outlive this.
  Practice(Poller& poller, std::string bench, Answer answer);

  // Passes on {"faults":[...]}, or {"end":true}; what both do to the arm is in docs/how-to/run-hil.md.
  void ask(const Json& request, std::optional<std::int64_t> id);

 private:
  void take(const std::string& packet);
  void lost();

  std::string bench_;
  ApiConnection link_;
  Answer answer_;
  std::deque<std::optional<std::int64_t>> open_;  // the bench answers in order
};

}  // namespace liana::gateway
