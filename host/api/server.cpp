#include "host/api/server.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <deque>
#include <tuple>

#include "host/api/outbox.hpp"
#include "host/api/peer.hpp"
#include "host/api/request_check.hpp"
#include "host/api/request_error.hpp"
#include "host/api/request_text.hpp"
#include "host/api/stop_packet.hpp"
#include "host/json/number_error.hpp"

namespace liana::api {

using Clock = std::chrono::steady_clock;

namespace {

// What one client has waiting for the next interval; beyond it the client's own sends wait. Kept as it came: read, it
// would be up to forty times as large.
constexpr std::size_t kMaxInbox = 512;          // requests
constexpr std::size_t kMaxInboxBytes = 262144;  // reached by the last of them at the most
constexpr std::size_t kMaxWaitingEvents = 64;   // of one subscriber; the others wait in the history
constexpr std::size_t kMaxClients = 32;         // that have said hello
// Connections that have not: so many at once, each for so long. They take no place from clients.
constexpr std::size_t kMaxStrangers = 16;
constexpr double kStrangerPatience_s = 2.0;
// What clients outside lockstep get of one pump or dispatch together; each at least one packet. A stop is read within
// this, however many send however much.
constexpr double kShare_s = 0.002;
constexpr double kMuch = 16384;                   // bytes lately, of clients that are read only while there is time
constexpr std::size_t kLongestHeard = 16u << 20;  // of a packet that is too long a request; it may be a stop
// So late a lockstep client may be in every interval; what goes beyond it adds up.
constexpr double kFreeLateness_s = 0.5;
constexpr const char* kOtherUser =
    R"({"op":"error","code":"refused","message":"lianad talks to programs of its own user, of root and of its --group"})";
constexpr const char* kNoPlace = "32 clients are connected already; close one (a stop is heard all the same)";

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Names stand in states, events and lists that people read in a terminal.
std::string name_of(const Arguments& hello) {
  std::string name = hello.text("name");
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (std::any_of(name.begin(), name.end(), is_control))
    throw RequestError("bad_request", "name: allowed is a text without control characters: leave them out");
  return name;
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

// Of hello and done, whose ranges are the same for every robot.
Arguments session_fields(const Json& request) {
  static const RequestBounds kNoRobot;
  return checked(row_of(request), request, kNoRobot);
}

}  // namespace

Role role_of(const std::string& name) {
  for (std::size_t i = 0; i < kRoleNames.size(); ++i) {
    if (name == kRoleNames[i]) return static_cast<Role>(i);
  }
  throw RequestError("bad_request", "role '" + name + "': allowed " + roles_text(kAnyRole));
}

struct ApiServer::Client {
  UniqueFd fd;
  ClientInfo info;
  bool greeted = false;
  bool only_stops = false;  // said hello when no place was left
  Clock::time_point since = Clock::now();
  double load = 0.0;       // bytes read lately: who sends little is read first
  std::string why_closed;  // not empty: to be buried
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

ApiServer::ApiServer(const std::string& path, ApiHandler& handler, std::optional<gid_t> group)
    : group_(group), listener_(listen_at("--api", path, group)), handler_(handler) {}
ApiServer::~ApiServer() = default;

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
    drop_strangers();
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
  drop_strangers();
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
  client.load += static_cast<double>(packet.size());
  take_packet(client, packet);
  return true;
}

// A newcomer has mostly said already what it wants. There is always a place to be heard from: strangers make room.
void ApiServer::accept_new() {
  for (std::size_t i = 0; i < kMaxStrangers; ++i) {
    const int fd = ::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) return;
    auto client = std::make_unique<Client>();
    client->fd = UniqueFd(fd);
    if (!is_admitted(fd, group_)) {
      send_packet(fd, kOtherUser);
      continue;
    }
    client->info.id = next_id_++;
    while (read_one(*client)) {
      if (client->load > kMaxPacketBytes) break;
    }
    flush(*client);
    clients_.push_back(std::move(client));
  }
}

// Connections that have not said hello, and those that had no place when they did: the oldest go when there are too
// many, and each goes when its time is over.
void ApiServer::drop_strangers() {
  std::vector<Client*> strangers;
  for (auto& client : clients_) {
    if (client->why_closed.empty() && (!client->greeted || client->only_stops)) strangers.push_back(client.get());
  }
  std::sort(strangers.begin(), strangers.end(), [](auto* a, auto* b) { return a->info.id < b->info.id; });
  for (std::size_t i = 0; i < strangers.size(); ++i) {
    if (strangers.size() - i > kMaxStrangers) close(*strangers[i], "made room for others before it said hello");
    if (seconds_since(strangers[i]->since) > kStrangerPatience_s) close(*strangers[i], "did not say hello within 2 s");
  }
  // At once, also where nobody dispatches: descriptors are few. The handler has never heard of them.
  std::erase_if(clients_, [](const auto& c) {
    return !c->why_closed.empty() && !c->has_work() && (!c->greeted || c->only_stops);
  });
}

void ApiServer::take_packet(Client& client, const std::string& packet) {
  Json request;
  try {
    if (packet.size() > kMaxPacketBytes)
      throw RequestError("bad_request", "packet over " + std::to_string(kMaxPacketBytes) + " bytes");
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

void ApiServer::greet(Client& client, const Json& request) {
  if (client.greeted) throw RequestError("bad_request", "hello was said already");
  const Arguments hello = session_fields(request);
  client.info.name = name_of(hello);
  client.info.role = role_of(hello.text("role"));
  client.info.lockstep = hello.flag("lockstep");
  require_free(client.info);
  subscribe(client, hello);
  client.greeted = true;
  const auto has_place = [](const auto& c) { return c->greeted && !c->only_stops && c->why_closed.empty(); };
  if (std::count_if(clients_.begin(), clients_.end(), has_place) >= static_cast<std::ptrdiff_t>(kMaxClients)) {
    client.only_stops = true;
    client.info.lockstep = false;
    client.subscribed = {};
    throw RequestError("busy", kNoPlace);
  }
  Json welcome = handler_.welcome(client.info);
  welcome["events"] = {{"oldest", events_.oldest()}, {"next", events_.next()}};
  if (request.contains("id")) welcome["id"] = request["id"];
  enqueue(client, Topic::kState, false, welcome.dump());
}

void ApiServer::require_free(const ClientInfo& wanted) const {
  if ((kSingleRoles & only(wanted.role)) == 0) return;
  for (const auto& other : clients_) {
    if (!other->greeted || other->only_stops || other->info.role != wanted.role || other->has_left()) continue;
    const std::optional<Peer> peer = peer_of(other->fd.get());
    throw RequestError("busy", std::string("role ") + role_name(wanted.role) + ": '" + other->info.name +
                                   "' has it (process " + std::to_string(peer ? peer->process : 0) +
                                   "), and one at a time may: end that one first");
  }
}

// Numbers begin anew with every lianad: one that is not there yet was learned from another.
void ApiServer::subscribe(Client& client, const Arguments& hello) const {
  client.subscribed = {};
  for (const std::string& topic : hello.texts("subscribe")) {
    const auto found = std::find(kTopicNames.begin(), kTopicNames.end(), topic);
    if (found == kTopicNames.end())
      throw RequestError("bad_request", "subscribe: allowed state, camera, tick, event, tool");
    client.subscribed[static_cast<std::size_t>(found - kTopicNames.begin())] = true;
  }
  if (client.subscribed[index_of(Topic::kTick)] && client.info.role != Role::kArchive)
    throw RequestError("bad_request", "subscribe: tick is for role archive: leave it out");
  if (client.subscribed[index_of(Topic::kTick)]) client.outbox.set_most_bytes(Outbox::kMaxBytesOfTicks);
  if (client.info.lockstep) client.subscribed[index_of(Topic::kState)] = true;
  client.next_event = events_.next();
  if (!hello.has("events_from")) return;
  const auto from = static_cast<std::uint64_t>(hello.integer("events_from"));
  if (from > events_.next()) {
    throw RequestError("out_of_range", "events_from = " + std::to_string(from) + ": allowed 1 to " +
                                           std::to_string(events_.next()) +
                                           ": lianad began anew and counts from 1; ask from there");
  }
  client.next_event = from;
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
    const SocketResult result = send_packet(client.fd.get(), client.outbox.front());
    if (result == SocketResult::kWouldBlock) return;
    if (result == SocketResult::kClosed) return client.outbox.clear();
    client.outbox.pop();
  }
}

void ApiServer::publish(Topic topic, const std::string& packet, bool keep) {
  for (auto& client : clients_) {
    if (!client->wants(topic)) continue;
    enqueue(*client, topic, topic != Topic::kTick && !keep, packet);
    flush(*client);
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
    double least_left_s = HUGE_VAL;
    for (auto& client : clients_) {
      if (client->late_for(tick) && left_s(client) <= 0.0) close(*client, "too late in lockstep time, or silent");
      if (client->late_for(tick)) least_left_s = std::min(least_left_s, left_s(client));
    }
    if (least_left_s == HUGE_VAL) break;
    pump(least_left_s);
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
