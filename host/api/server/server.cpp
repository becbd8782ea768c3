#include "host/api/server/server.hpp"

#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/server_client.hpp"
#include "host/api/server/stop_packet.hpp"
#include "host/base/json/number_error.hpp"

namespace liana::api {

namespace {

constexpr std::size_t kMaxWaitingEvents = 64;  // of one subscriber; the others wait in the history
// What clients outside lockstep get of one pump or dispatch together; each at least one packet. A stop is read within
// this, however many send however much.
constexpr double kShare_s = 0.002;
constexpr double kMuch = 16384;                   // bytes lately, of clients that are read only while there is time
constexpr std::size_t kLongestHeard = 16u << 20;  // of a packet that is too long a request; it may be a stop
// So late a lockstep client may be in every interval; what goes beyond it adds up.
constexpr double kFreeLateness_s = 0.5;
// After so long without a word of a client it is asked whether it reads.
constexpr double kQuiet_s = 0.03;
constexpr std::size_t kSentAtOnce = 16;  // packets
// Bytes that the other end has not read yet.
int unread_bytes(int fd) {
  int bytes = 0;
  return ::ioctl(fd, SIOCOUTQ, &bytes) == 0 ? bytes : 0;
}

std::string error_packet(const Json& request, const std::string& code, const std::string& message) {
  Json answer{{"op", "error"}, {"code", code}, {"message", message}};
  if (request.is_object() && request.contains("id")) answer["id"] = request["id"];
  return answer.dump(-1, Json::BadUtf8::kReplace);
}

// To a reader of events that were not kept for it.
std::string lost_packet(std::uint64_t first, std::uint64_t last) {
  return Json{{"op", "events_lost"}, {"from", first}, {"to", last}, {"count", last - first + 1}}.dump();
}

std::string op_of(const Json& request) {
  const auto op = request.find("op");
  return op != nullptr && op->is_string() ? op->get<std::string>() : std::string();
}

}  // namespace

ApiServer::ApiServer(const std::string& path, ApiHandler& handler, std::optional<gid_t> group)
    : path_(path), group_(group), listener_(listen_at("--api", path, group)), handler_(handler) {
  drop_unidentified();
}
ApiServer::~ApiServer() { ::unlink(path_.c_str()); }

void ApiServer::pump(double timeout_s, int others) {
  std::vector<pollfd> polled{{listener_.get(), POLLIN, 0}};
  for (const auto& client : clients_) {
    const int in = client->readable(lockstep_tick_) ? POLLIN : 0;
    const int out = client->outbox.empty() ? 0 : POLLOUT;
    const bool watched = client->why_closed.empty() && (in | out) != 0;  // a hang-up would wake us again and again
    polled.push_back({watched ? client->fd.get() : -1, static_cast<short>(in | out), 0});
  }
  polled.push_back({others, POLLIN, 0});
  if (::poll(polled.data(), polled.size(), timeout_s > 0.0 ? static_cast<int>(timeout_s * 1e3) + 1 : 0) <= 0) {
    drop_unidentified();
    return;
  }
  std::vector<Client*> talking;
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    const short events = polled[i + 1].revents;
    if ((events & POLLOUT) != 0) flush(*clients_[i]);
    if ((events & (POLLIN | POLLHUP | POLLERR)) != 0) talking.push_back(clients_[i].get());
  }
  read_from(talking);
  if (polled[0].revents != 0) accept_new();
  drop_unidentified();
}

// Lockstep clients are read to the end, whatever the time: runs repeat. The others share a bounded time, one packet
// each and those first that have sent little.
void ApiServer::read_from(std::vector<Client*>& talking) {
  const Clock::time_point start = Clock::now();
  for (auto& client : clients_) client->load *= 0.5;
  for (Client* client : talking) {
    while (client->in_lockstep() && read_one(*client)) {
    }
  }
  std::erase_if(talking, [](const Client* client) { return client->in_lockstep(); });
  const auto has_had_enough = [start](const Client* client) {
    return client->load > kMuch && seconds_since(start) > kShare_s;
  };
  do {
    std::stable_sort(talking.begin(), talking.end(), [](auto* a, auto* b) { return a->load < b->load; });
    std::erase_if(talking, [&](Client* client) { return has_had_enough(client) || !read_one(*client); });
  } while (!talking.empty() && seconds_since(start) < kShare_s);
}

// False when there is nothing more to read now.
bool ApiServer::read_one(Client& client) {
  if (!client.why_closed.empty() || !client.readable(lockstep_tick_)) return false;
  std::string packet;
  const SocketResult result = receive_packet(client.fd.get(), packet, kLongestHeard);
  if (result == SocketResult::kClosed) close(client, "connection closed");
  if (result != SocketResult::kDone) return false;
  client.alive_at = Clock::now();
  client.load += static_cast<double>(packet.size());
  take_packet(client, packet);
  return true;
}

void ApiServer::take_packet(Client& client, const std::string& packet) {
  Json request;
  try {
    if (packet.size() > kMaxPacketBytes) {
      throw RequestError("bad_request",
                         "packet over " + std::to_string(kMaxPacketBytes) + " bytes: send a smaller one");
    }
    request = Json::parse(packet);
    if (!request.is_object()) throw RequestError("bad_request", "a request is one JSON object");
    if (request.contains("id") && !request["id"].is_number_integer()) {
      request.erase("id");
      throw RequestError("bad_request", "field 'id': must be a whole number");
    }
    const std::string op = op_of(request);
    if (op == "hello") return greet(client, request);
    if (!client.greeted)
      throw RequestError("bad_request", "say hello first: {\"op\":\"hello\",\"name\":...,\"role\":...}");
    if (op == "done") {
      client.done_tick = static_cast<std::uint64_t>(session_fields(request).integer("tick"));
      client.has_done = true;
      client.done_at = Clock::now();
      return;
    }
    if (op == "stop") return take_stop(client, std::move(request));
    if (client.only_stops) throw RequestError("busy", kNoPlace);
    client.inbox.push_back(packet);
    client.inbox_bytes += packet.size();
  } catch (const RequestError& error) {
    if (!take_bad_stop(client, packet, error.what()))
      enqueue(client, Topic::kState, false, error_packet(request, error.code(), error.what()));
  } catch (const JsonNumberError& error) {
    if (!take_bad_stop(client, packet, error.what()))
      enqueue(client, Topic::kState, false, error_packet(Json(), "out_of_range", error.what()));
  } catch (const JsonError& error) {
    const std::string why = std::string("not JSON: ") + error.what();
    if (!take_bad_stop(client, packet, why))
      enqueue(client, Topic::kState, false, error_packet(Json(), "bad_request", why));
  }
}

// A stop is taken however it is written; the answer says what was wrong with it.
bool ApiServer::take_bad_stop(Client& client, const std::string& packet, const std::string& why) {
  const StopPacket stop = client.greeted ? read_stop(packet) : StopPacket{};
  if (stop.is_stop) take_stop(client, {{"op", "stop"}, {"reason", stop.reason}, {"remark", why}});
  return stop.is_stop;
}

// At once, also while others are waited for. In lockstep time a client's stop has its place among its other requests.
void ApiServer::take_stop(Client& client, Json stop) {
  client.stops.push_back(std::move(stop));
  if (client.in_lockstep() && lockstep_tick_ != UINT64_MAX) return;
  serve_stops(client);
  flush(client);
}

void ApiServer::dispatch() {
  std::sort(clients_.begin(), clients_.end(), [](const auto& a, const auto& b) { return a->order() < b->order(); });
  for (auto& client : clients_) serve_stops(*client);
  const auto busy = std::count_if(clients_.begin(), clients_.end(), [](const auto& c) { return c->has_work(); });
  for (auto& client : clients_) {
    serve(*client, kShare_s / static_cast<double>(busy + 1));
    flush(*client);
  }
  bury();
}

// What a client outside lockstep has beyond its share waits for the next call.
void ApiServer::serve(Client& client, double share_s) {
  const Clock::time_point start = Clock::now();
  while (!client.inbox.empty()) {
    const std::string packet = std::move(client.inbox.front());
    client.inbox.pop_front();
    client.inbox_bytes -= packet.size();
    serve_one(client, packet);
    if (!client.info.lockstep && seconds_since(start) > share_s) return;
  }
}

void ApiServer::serve_stops(Client& client) {
  while (!client.stops.empty()) {
    const Json stop = std::move(client.stops.front());
    client.stops.pop_front();
    answer_one(client, stop);
  }
}

// It was JSON when it came.
void ApiServer::serve_one(Client& client, const std::string& packet) { answer_one(client, Json::parse(packet)); }

void ApiServer::answer_one(Client& client, const Json& request) {
  try {
    Json answer = handler_.handle(client.info, request);
    if (!request.contains("id") && !request.contains("remark")) return;
    answer["op"] = "ok";
    for (const char* key : {"id", "remark"}) {
      if (request.contains(key)) answer[key] = request[key];
    }
    enqueue(client, Topic::kState, false, answer.dump(-1, Json::BadUtf8::kReplace));
  } catch (const RequestError& error) {
    enqueue(client, Topic::kState, false, error_packet(request, error.code(), error.what()));
  } catch (const JsonError& error) {
    enqueue(client, Topic::kState, false, error_packet(request, "bad_request", error.what()));
  }
}

void ApiServer::enqueue(Client& client, Topic topic, bool droppable, const std::string& packet) {
  const std::uint64_t before = client.outbox.dropped();
  const bool taken = client.outbox.add(topic, droppable && !client.info.lockstep, packet);
  dropped_ += client.outbox.dropped() - before;
  if (taken) return;
  if (topic != Topic::kTick) return close(client, "does not read its socket");
  ++dropped_;
  ++dropped_ticks_;
}

// As far as there is room: others wait in the history, and what is forgotten there is said to be lost. In lockstep time
// nothing is, and events have their place among the other packets whatever the moment at which they are read.
void ApiServer::feed_events(Client& client) {
  if (!client.wants(Topic::kEvent)) return;
  if (client.next_event < events_.oldest() && client.outbox.waiting(Topic::kEvent) == 0) {
    enqueue(client, Topic::kEvent, false, lost_packet(client.next_event, events_.oldest() - 1));
    client.next_event = events_.oldest();
  }
  while (client.next_event >= events_.oldest() && client.next_event < events_.next()) {
    if (!client.info.lockstep && client.outbox.waiting(Topic::kEvent) >= kMaxWaitingEvents) return;
    enqueue(client, Topic::kEvent, false, events_.packet(client.next_event++));
  }
}

// That a client has left is found by reading alone: its last requests come before its end, and in lockstep time both
// wait for the next interval, whatever the moment at which a packet to it fails.
void ApiServer::flush(Client& client) {
  for (feed_events(client); !client.outbox.empty() && client.why_closed.empty(); feed_events(client)) {
    const bool is_quiet = seconds_since(client.alive_at) > kQuiet_s;
    if (is_quiet && unread_bytes(client.fd.get()) < client.unread_bytes) client.alive_at = Clock::now();  // it has read
    std::array<std::string_view, kSentAtOnce> oldest;
    const std::size_t count = std::min(client.outbox.size(), oldest.size());
    for (std::size_t i = 0; i < count; ++i) oldest[i] = client.outbox.at(i);
    std::span<const std::string_view> left(oldest.data(), count);
    const SocketResult result = send_packets(client.fd.get(), left);
    if (result == SocketResult::kClosed) return client.outbox.clear();
    if (left.size() < count) client.unread_bytes = is_quiet ? unread_bytes(client.fd.get()) : 0;
    for (std::size_t i = left.size(); i < count; ++i) client.outbox.pop();
    if (result == SocketResult::kWouldBlock) return;
  }
}

void ApiServer::publish(Topic topic, const std::string& packet, bool keep) {
  for (auto& client : clients_) {
    if (!client->wants(topic)) continue;
    enqueue(*client, topic, topic != Topic::kTick && !keep, packet);
    if (topic != Topic::kTick || client->outbox.waiting(topic) >= kSentAtOnce) flush(*client);
  }
}

void ApiServer::publish_event(const std::string& packet) {
  events_.push(packet);
  for (auto& client : clients_) flush(*client);
}

void ApiServer::deliver(double timeout_s) {
  const Clock::time_point start = Clock::now();
  const auto waits = [](const auto& client) { return client->why_closed.empty() && !client->outbox.empty(); };
  while (std::any_of(clients_.begin(), clients_.end(), waits) && seconds_since(start) < timeout_s) pump(0.05);
}

void ApiServer::wait_done(std::uint64_t tick, double timeout_s) {
  lockstep_tick_ = tick;
  for (auto& client : clients_) client->awaited = client->greeted;
  const Clock::time_point start = Clock::now();
  const auto left_s = [&](const auto& client) { return timeout_s - client->late_s - seconds_since(start); };
  for (;;) {
    double min_left_s = HUGE_VAL;
    for (auto& client : clients_) {
      if (client->late_for(tick) && left_s(client) <= 0.0) close(*client, "too late in lockstep time, or silent");
      if (client->late_for(tick)) min_left_s = std::min(min_left_s, left_s(client));
    }
    if (min_left_s == HUGE_VAL) break;
    pump(min_left_s);
  }
  for (auto& client : clients_) {
    const double waited_s = std::chrono::duration<double>(client->done_at - start).count();
    client->late_s = std::max(0.0, client->late_s + std::max(0.0, waited_s) - kFreeLateness_s);
  }
}

bool ApiServer::has_role(Role role) const {
  return std::any_of(clients_.begin(), clients_.end(),
                     [role](const auto& c) { return c->greeted && !c->only_stops && c->info.role == role; });
}

double ApiServer::silence_s(std::uint32_t id) const {
  const auto found = std::find_if(clients_.begin(), clients_.end(), [id](const auto& c) { return c->info.id == id; });
  return found == clients_.end() ? 0.0 : seconds_since((*found)->alive_at);
}

bool ApiServer::has_subscriber(Topic topic) const {
  return std::any_of(clients_.begin(), clients_.end(), [topic](const auto& c) { return c->wants(topic); });
}

void ApiServer::close(Client& client, const std::string& why) {
  if (client.why_closed.empty()) client.why_closed = why;
}

// After their last requests have been handled (an emergency stop may be among them): the death of an owner is a hold.
void ApiServer::bury() {
  std::vector<std::unique_ptr<Client>> dead;
  for (auto& client : clients_) {
    if (!client->why_closed.empty() && !client->has_work()) dead.push_back(std::move(client));
  }
  std::erase(clients_, nullptr);
  for (const auto& client : dead) {
    if (client->greeted && !client->only_stops) handler_.gone(client->info, client->why_closed);
  }
}

}  // namespace liana::api
