#include "host/apps/mission_runner/session.hpp"

#include <cstdio>
#include <stdexcept>

#include "host/api/server/request_error.hpp"
#include "host/apps/mission_runner/follow_plan.hpp"

namespace liana::mission_runner {
namespace {

constexpr double kWelcome_s = 30.0;
constexpr double kWait_s = 0.5;
constexpr int kMaxAtOnce = 400;  // of the 512 that lianad takes of a client in an interval
constexpr int kReserve = 32;     // for what a step does when it has failed by that

std::string progress_line(const Json& event) {
  char line[300];
  const std::string name = event.value("name", "");
  const int index = event.value("index", 0);
  const int count = event.value("count", 0);
  if (event.value("event", "") == "wait") {
    std::snprintf(line, sizeof line, "%8.2f s  step %d/%d  %-36s  waits, %s", event.value("time_s", 0.0), index, count,
                  name.c_str(), event.value("reason", "").c_str());
  } else if (event.value("event", "") == "begin") {
    std::snprintf(line, sizeof line, "%8.2f s  step %d/%d  %-36s  device %s", event.value("time_s", 0.0), index, count,
                  name.c_str(), event.value("device", "").c_str());
  } else {
    const std::string why = event.value("reason", "").empty() ? event.value("ended_by", "") : event.value("reason", "");
    std::snprintf(line, sizeof line, "%8.2f s  step %d/%d  %-36s  %s after %.2f s%s%s", event.value("time_s", 0.0),
                  index, count, name.c_str(), event.value("outcome", "").c_str(), event.value("duration_s", 0.0),
                  why.empty() ? "" : ": ", why.c_str());
  }
  return line;
}

}  // namespace

MissionSession::MissionSession(const MissionOptions& options, Activity& activity)
    : options_(options),
      activity_(activity),
      report_(activity),
      client_(api::ApiClient::connect(options.api, kWelcome_s)) {
  client_.send({{"op", "hello"},
                {"name", "mission"},
                {"role", "mission"},
                {"lockstep", options.lockstep},
                {"subscribe", {"state"}}});
  for (double waited_s = 0.0; waited_s < kWelcome_s; waited_s += kWait_s) {
    const auto message = client_.receive(kWait_s);
    activity_.beat();
    if (!message) continue;
    if (message->value("op", "") == "error")
      throw std::runtime_error("lianad refuses the mission runner: " + message->value("message", ""));
    welcome_ = *message;
    activity_.period_s = welcome_.value("period_s", 0.0);
    return;
  }
  throw std::runtime_error(options.api + ": lianad does not answer: is it running?");
}

Json MissionSession::next() {
  made_at_once_ = 0;
  max_at_once_ = kMaxAtOnce;
  activity_.beat();
  auto message = client_.receive(kWait_s);
  activity_.beat();
  if (!message) return {};
  if (message->value("op", "") == "state")
    activity_.tick.store(message->value("tick", std::uint64_t{0}), std::memory_order_relaxed);
  return std::move(*message);
}

void MissionSession::done(std::int64_t tick) {
  if (options_.lockstep) client_.send({{"op", "done"}, {"tick", tick}});
}

void MissionSession::hold_quietly() {
  try {
    client_.send({{"op", "hold"}});
  } catch (const std::exception&) {
    // lianad is gone, or holds because its owner is
  }
}

std::int64_t MissionSession::request(const api::RequestRow& row, Json fields) {
  if (made_at_once_ >= max_at_once_) {
    max_at_once_ = kMaxAtOnce + kReserve;
    throw api::RequestError("busy", std::to_string(kMaxAtOnce) + " requests at once: allowed no more before the next " +
                                        "state: make them one after the other, as the arm carries them out");
  }
  ++made_at_once_;
  fields["op"] = row.op;
  fields["id"] = ++last_id_;
  client_.send(fields);
  return last_id_;
}

void MissionSession::progress(const Json& event) {
  if (options_.json) std::printf("%s\n", event.dump().c_str());
  if (options_.progress && !options_.json) std::printf("%s\n", progress_line(event).c_str());
  std::fflush(stdout);
}

const Json& MissionSession::plan_curve(const Json& request) {
  activity_.beat();
  plan_ = follow_plan(welcome_, request);
  return plan_;
}

}  // namespace liana::mission_runner
