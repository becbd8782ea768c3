// The daemon's end of the API socket: clients, sessions, bounded queues. Never blocks on a client.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/api/server/arguments.hpp"
#include "host/api/server/packet_history.hpp"
#include "host/api/server/role.hpp"
#include "host/api/server/topic.hpp"
#include "host/base/json/json_fwd.hpp"
#include "host/base/net/socket.hpp"

namespace liana::api {

// One greeted client, as the handler sees it.
struct ClientInfo {
  std::uint32_t id = 0;  // 1, 2, ... never reused
  std::string name;
  Role role = Role::kObserver;
  bool lockstep = false;
  std::int32_t process = 0;  // 0 = the kernel does not say
};

// What the daemon does with requests.
class ApiHandler {
 public:
  virtual ~ApiHandler() = default;
  // The welcome message for a new client.
  virtual Json welcome(const ClientInfo& client) = 0;
  // Acts on one request; the result's fields join the "ok" answer. Throws RequestError to refuse.
  virtual Json handle(const ClientInfo& client, const Json& request) = 0;
  // The client has died or left.
  virtual void gone(const ClientInfo& client, const std::string& why) = 0;
};

class ApiServer {
 public:
  // Listens at `path` for programs of this user and of root, and of members of `group` where one is given; throws
  // std::runtime_error. Its end removes the socket.
  ApiServer(const std::string& path, ApiHandler& handler, std::optional<gid_t> group = std::nullopt);
  ~ApiServer();

  // Moves packets between sockets and queues, waiting up to `timeout_s` for something to do. A stop of a client outside
  // lockstep is handed to the handler at once. Clients outside lockstep that send much are read for 2 ms in all.
  // Also wakes when `others`, a descriptor of somebody else, is readable.
  void pump(double timeout_s, int others = -1);
  // Hands every queued request to the handler: stops of all clients first, then the others by role and name of the
  // client, each in its own order. Clients outside lockstep share 2 ms; what is left waits for the next call.
  void dispatch();
  // Sends to every subscriber of the topic. Slow subscribers lose their oldest state and camera messages, and newest
  // ticks (counted), but no message that was published as one to `keep`. Ticks may wait for the next pump() or
  // dispatch(), to go together.
  void publish(Topic topic, const std::string& packet, bool keep = false);
  // Sends the next event (1, 2, ...) to subscribers of `event`. Who reads too slowly gets it later, while it is among
  // the newest PacketHistory::kKept; after that a packet events_lost says which ones are gone.
  void publish_event(const std::string& packet);
  // Sends what waits for slow readers, at most for `timeout_s`; for the end.
  void deliver(double timeout_s);
  // Pumps until every lockstep client has answered the state of `tick` with done; drops those silent for `timeout_s`,
  // and those for which time has waited so long in all, half a second of each interval left out. What a lockstep client
  // sends after its done, its end included, is read in the next call, so that runs repeat.
  void wait_done(std::uint64_t tick, double timeout_s);
  // From now on lockstep clients are read like all others.
  void end_lockstep() { lockstep_tick_ = UINT64_MAX; }
  // True when a client with this role has said hello.
  bool has_role(Role role) const;
  // True when somebody subscribes to the topic.
  bool has_subscriber(Topic topic) const;
  // For how long the client has neither sent nor read anything, s of this machine's time; 0 for a number that no client
  // has.
  double silence_s(std::uint32_t id) const;
  // Packets thrown away because a subscriber was slow.
  std::uint64_t dropped() const { return dropped_; }
  // Tick packets among them.
  std::uint64_t dropped_ticks() const { return dropped_ticks_; }

 private:
  struct Client;
  void accept_new();
  UniqueFd accept_one();
  void take_in(UniqueFd fd);
  std::vector<Client*> strangers() const;
  void drop_unidentified();
  void close_oldest_strangers(std::size_t most, const std::string& why);
  void forget_closed_strangers();
  void read_from(std::vector<Client*>& talking);
  bool read_one(Client& client);
  void take_packet(Client& client, const std::string& packet);
  bool take_bad_stop(Client& client, const std::string& packet, const std::string& why);
  void greet(Client& client, const Json& request);
  void refuse_place(Client& client, const char* why) const;
  void require_free(const ClientInfo& wanted) const;
  void subscribe(Client& client, const Arguments& hello) const;
  void take_stop(Client& client, Json stop);
  void serve_stops(Client& client);
  void serve(Client& client, double share_s);
  void serve_one(Client& client, const std::string& packet);
  void answer_one(Client& client, const Json& request);
  void enqueue(Client& client, Topic topic, bool droppable, const std::string& packet);
  void feed_events(Client& client);
  void flush(Client& client);
  void close(Client& client, const std::string& why);
  void bury();

  std::string path_;
  std::optional<gid_t> group_;
  UniqueFd listener_;
  UniqueFd spare_;  // given up where a newcomer finds no other descriptor: it may want to stop the arm
  ApiHandler& handler_;
  std::vector<std::unique_ptr<Client>> clients_;  // in serving order
  std::uint32_t next_id_ = 1;
  PacketHistory events_;
  std::uint64_t lockstep_tick_ = 0;
  std::uint64_t dropped_ = 0, dropped_ticks_ = 0;
};

// Role of its name in docs/reference/api.md; throws RequestError for others.
Role role_of(const std::string& name);
}  // namespace liana::api
