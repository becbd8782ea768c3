// The emergency stop of one client: over a connection of its own, so that it waits behind nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/gateway/api_connection.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {

class StopCall {
 public:
  static constexpr double kPatience_s = 0.9;  // until it is said that lianad did not confirm
  static constexpr std::size_t kMaxIds = 64;  // of stops that one confirmation answers

  using Answer = std::function<void(const Json& answer)>;

  // `name` is who stops the arm, as states and events tell. `poller` must outlive this.
  StopCall(Poller& poller, const std::string& api, std::string name, Answer answer);

  // Sends a stop now, unless one is under way, whose confirmation answers this one, too.
  void press(double now_s, std::optional<std::int64_t> id, const std::string& reason);
  // Tries again where lianad could not be reached, for kPatience_s; to be called ten times a second.
  void tick(double now_s);

 private:
  void call();
  void take(const std::string& packet);
  void end(Json lianad_says);

  ApiConnection link_;
  std::string name_, reason_;
  Answer answer_;
  std::vector<std::optional<std::int64_t>> ids_;  // not empty: a stop is under way
  double since_s_ = 0.0;
};

}  // namespace liana::gateway
