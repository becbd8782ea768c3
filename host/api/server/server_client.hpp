// What the API server knows of one client; for the parts of the server alone.
#pragma once

#include <poll.h>

#include <array>
#include <chrono>
#include <deque>
#include <string>
#include <tuple>

#include "host/api/server/outbox.hpp"
#include "host/api/server/server.hpp"
#include "host/base/json/json.hpp"

namespace liana::api {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// What one client has waiting for the next interval; beyond it the client's own sends wait. Kept as it came: read, it
// would be up to forty times as large.
constexpr std::size_t kMaxInbox = 512;          // requests
constexpr std::size_t kMaxInboxBytes = 262144;  // reached by the last of them at the most
constexpr const char* kNoPlace = "32 clients are connected already; close one (a stop is heard all the same)";

// The checked fields of hello or done, whose ranges are the same for every robot; throws RequestError.
Arguments session_fields(const Json& request);

struct ApiServer::Client {
  UniqueFd fd;
  ClientInfo info;
  bool greeted = false;
  bool only_stops = false;  // said hello when no place was left
  Clock::time_point since = Clock::now();
  Clock::time_point alive_at = since;  // it has sent or read something
  int unread_bytes = 0;                // by it, right after the last packet to it; 0 where nobody asked
  double load = 0.0;                   // bytes read lately: who sends little is read first
  std::string why_closed;              // not empty: to be buried
  std::array<bool, kTopicNames.size()> subscribed{};
  std::uint64_t done_tick = 0;
  bool has_done = false;
  Clock::time_point done_at{};
  double late_s = 0.0;   // in all that virtual time has waited for it, less kFreeLateness_s for every interval
  bool awaited = false;  // was there when waiting began: who joins meanwhile cannot answer a state it never got
  std::deque<std::string> inbox;
  std::size_t inbox_bytes = 0;
  std::deque<Json> stops;  // served before everybody's inbox
  Outbox outbox;
  std::uint64_t next_event = 0;  // number of the next one to put into the outbox

  auto order() const { return std::tie(info.role, info.name, info.id); }
  bool wants(Topic topic) const { return greeted && why_closed.empty() && subscribed[index_of(topic)]; }
  bool has_work() const { return !stops.empty() || !inbox.empty(); }
  bool in_lockstep() const { return greeted && info.lockstep && why_closed.empty(); }
  bool is_done(std::uint64_t tick) const { return has_done && done_tick == tick; }
  bool late_for(std::uint64_t tick) const { return in_lockstep() && awaited && !is_done(tick); }
  bool has_room() const { return inbox.size() < kMaxInbox && inbox_bytes < kMaxInboxBytes; }
  bool readable(std::uint64_t tick) const { return has_room() && !(in_lockstep() && is_done(tick)); }
  // Has left, though what it sent before may not have been read yet.
  bool has_left() const {
    pollfd polled{fd.get(), 0, 0};
    return !why_closed.empty() || (::poll(&polled, 1, 0) > 0 && (polled.revents & (POLLHUP | POLLERR)) != 0);
  }
};

}  // namespace liana::api
