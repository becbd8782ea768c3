// Who comes to the API server: connections, and the hello that makes clients of them.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"
#include "host/api/server/server_client.hpp"
#include "host/base/net/peer.hpp"

namespace liana::api {

namespace {

constexpr std::size_t kMaxClients = 32;  // that have said hello
// Connections that have not: so many at once, each for so long. They take no place from clients.
constexpr std::size_t kMaxStrangers = 16;
constexpr double kStrangerPatience_s = 2.0;
constexpr std::size_t kMaxArrivals = 64;  // of one pump: what waits at the listener
// The last descriptors of this process are for files and for those who stop the arm; few strangers at once have them.
constexpr rlim_t kKeptDescriptors = 8;
constexpr std::size_t kFewStrangers = 4;
constexpr const char* kOtherUser =
    R"({"op":"error","code":"refused","message":"lianad talks to programs of its own user, of root and of its --group"})";
constexpr const char* kNoDescriptor =
    "lianad has no file descriptors left; close clients or raise its limit (ulimit -n); a stop is heard all the same";

// One of the last that this process may have.
bool is_scarce(int fd) {
  rlimit most{};
  return ::getrlimit(RLIMIT_NOFILE, &most) == 0 && static_cast<rlim_t>(fd) + kKeptDescriptors >= most.rlim_cur;
}

// Names stand in states, events and lists that people read in a terminal.
std::string name_of(const Arguments& hello) {
  std::string name = hello.text("name");
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (std::any_of(name.begin(), name.end(), is_control))
    throw RequestError("bad_request", "name: allowed is a text without control characters: leave them out");
  return name;
}

}  // namespace

Arguments session_fields(const Json& request) {
  static const RequestBounds kNoRobot;
  return checked(row_of(request), request, kNoRobot);
}

Role role_of(const std::string& name) {
  for (std::size_t i = 0; i < kRoleNames.size(); ++i) {
    if (name == kRoleNames[i]) return static_cast<Role>(i);
  }
  throw RequestError("bad_request", "role '" + name + "': allowed " + roles_text(kAnyRole));
}

// There is always a place to be heard from: strangers make room, and one descriptor is kept.
void ApiServer::accept_new() {
  for (std::size_t i = 0; i < kMaxArrivals; ++i) {
    UniqueFd fd = accept_one();
    if (fd.get() < 0) return;
    if (is_admitted(fd.get(), group_)) {
      take_in(std::move(fd));
    } else {
      send_packet(fd.get(), kOtherUser);
    }
  }
}

UniqueFd ApiServer::accept_one() {
  UniqueFd fd = accept_now(listener_.get());
  if (fd.get() >= 0 || (errno != EMFILE && errno != ENFILE)) return fd;
  const std::size_t others = strangers().size();
  if (others == 0) spare_ = UniqueFd();
  if (others > 0) close_oldest_strangers(others - 1, "made room for others: no file descriptor was left");
  return accept_now(listener_.get());
}

// A newcomer has mostly said already what it wants.
void ApiServer::take_in(UniqueFd fd) {
  auto client = std::make_unique<Client>();
  const bool few_are_left = is_scarce(fd.get());
  const std::optional<Peer> peer = peer_of(fd.get());
  client->fd = std::move(fd);
  client->info.id = next_id_++;
  client->info.process = peer ? peer->process : 0;
  while (read_one(*client)) {
    if (client->load > kMaxPacketBytes) break;
  }
  flush(*client);
  clients_.push_back(std::move(client));
  close_oldest_strangers(few_are_left ? kFewStrangers : kMaxStrangers, "made room for others before it said hello");
}

// Connections that have not said hello, and those that had no place when they did; the oldest first.
std::vector<ApiServer::Client*> ApiServer::strangers() const {
  std::vector<Client*> found;
  for (const auto& client : clients_) {
    if (client->why_closed.empty() && (!client->greeted || client->only_stops)) found.push_back(client.get());
  }
  std::sort(found.begin(), found.end(), [](auto* a, auto* b) { return a->info.id < b->info.id; });
  return found;
}

void ApiServer::close_oldest_strangers(std::size_t most, const std::string& why) {
  const std::vector<Client*> found = strangers();
  for (std::size_t i = 0; i + most < found.size(); ++i) close(*found[i], why);
  forget_closed_strangers();
}

// At once, also where nobody dispatches: descriptors are few. The handler has never heard of them.
void ApiServer::forget_closed_strangers() {
  std::erase_if(clients_, [](const auto& c) {
    return !c->why_closed.empty() && !c->has_work() && (!c->greeted || c->only_stops);
  });
}

void ApiServer::drop_unidentified() {
  for (Client* stranger : strangers()) {
    if (seconds_since(stranger->since) > kStrangerPatience_s) close(*stranger, "did not say hello within 2 s");
  }
  forget_closed_strangers();
  keep_spare(spare_);
}

void ApiServer::greet(Client& client, const Json& request) {
  if (client.greeted) throw RequestError("bad_request", "hello was said already: send it once");
  const Arguments hello = session_fields(request);
  client.info.name = name_of(hello);
  client.info.role = role_of(hello.text("role"));
  client.info.lockstep = hello.flag("lockstep");
  require_free(client.info);
  subscribe(client, hello);
  client.greeted = true;
  const auto has_place = [](const auto& c) { return c->greeted && !c->only_stops && c->why_closed.empty(); };
  const bool is_full = std::count_if(clients_.begin(), clients_.end(), has_place) >= std::ptrdiff_t{kMaxClients};
  if (is_full || is_scarce(client.fd.get())) refuse_place(client, is_full ? kNoPlace : kNoDescriptor);
  Json welcome = handler_.welcome(client.info);
  welcome["events"] = {{"oldest", events_.oldest()}, {"next", events_.next()}};
  if (request.contains("id")) welcome["id"] = request["id"];
  enqueue(client, Topic::kState, false, welcome.dump());
}

void ApiServer::refuse_place(Client& client, const char* why) const {
  client.only_stops = true;
  client.info.lockstep = false;
  client.subscribed = {};
  throw RequestError("busy", why);
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

}  // namespace liana::api
