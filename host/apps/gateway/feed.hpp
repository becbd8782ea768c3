// What lianad tells everybody: heard over one connection, parsed once for all clients.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "host/api/telemetry/layout.hpp"
#include "host/apps/gateway/api_connection.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {

class Feed {
 public:
  static constexpr std::size_t kKeptEvents = 1024;
  static constexpr double kMinBetween_s = 0.005;  // two records: in fast time there are more states than eyes

  // `changed` is told when there is something new. `poller` must outlive this.
  Feed(Poller& poller, const std::string& api, std::function<void()> changed);

  // Connects, unless it is; to be called ten times a second.
  void connect();
  // Makes a record of the newest state, unless the last one is too young or nobody looks (`wanted`); to be called after
  // packets were read. `now_s`: any clock that never goes back.
  void publish(double now_s, bool wanted);

  // Counts the lives of lianad that have begun to tell states; 0: none yet.
  std::uint32_t life() const { return life_; }
  // Why there are no states now; empty when there are.
  const std::string& away() const { return away_; }
  // What every client's welcome says of this life; empty before the first state.
  const Json& welcome() const { return welcome_; }
  // The newest state as lianad sent it; empty while there is none.
  const std::string& state() const { return newest_state_; }
  // When it came, by the clock of publish().
  double heard_s() const { return heard_s_; }
  // The newest record and its sequence (0: none of this life yet).
  const std::string& record() const { return record_; }
  std::uint32_t sequence() const { return record_.empty() ? 0 : sequence_; }
  // The newest facts as a message, and their number.
  const std::string& facts() const { return facts_message_; }
  std::uint32_t facts_number() const { return facts_number_; }
  // Events from oldest_event() to next_event() - 1, as lianad told them.
  std::uint64_t oldest_event() const { return next_event_ - events_.size(); }
  std::uint64_t next_event() const { return next_event_; }
  const std::string& event(std::uint64_t sequence) const { return events_[sequence - oldest_event()]; }

 private:
  void take(const std::string& packet);
  void take_other(const std::string& packet);
  void say(const std::string& problem);
  void begin_life(const Json& state);
  void keep_event(const std::string& packet);
  void lost();

  ApiConnection link_;
  std::function<void()> changed_;
  std::string away_, said_;
  std::uint32_t life_ = 0;
  Json lianad_says_;  // its welcome
  Json welcome_;
  std::optional<telemetry::Layout> layout_;
  std::string newest_state_;
  bool is_recorded_ = false;  // the newest state
  bool is_new_ = false;       // it has come since the last publish()
  double heard_s_ = -1e9;
  double published_s_ = -1.0;
  std::string record_;
  std::uint32_t sequence_ = 0;
  Json facts_;
  std::string facts_message_;
  std::uint32_t facts_number_ = 0;
  std::deque<std::string> events_;
  std::uint64_t next_event_ = 1;
};

}  // namespace liana::gateway
