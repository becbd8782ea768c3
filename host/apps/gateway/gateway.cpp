#include "host/apps/gateway/gateway.hpp"

#include <algorithm>
#include <utility>

#include "host/apps/gateway/metrics.hpp"
#include "host/apps/gateway/proof.hpp"

namespace liana::gateway {

namespace {
constexpr std::uint16_t kTryAgainLater = 1013;  // of the IANA registry of WebSocket close codes
constexpr double kOld_s = 5.0;                  // a state that nothing followed: lianad stands still
}  // namespace

Gateway::Gateway(const std::string& api, const std::string& devices, const Tokens* tokens, bool is_loopback,
                 std::function<double()> now_s, Programs programs)
    : now_s_(std::move(now_s)),
      feed_(poller_, api, [this] { wake_all(); }),
      house_{poller_,
             feed_,
             api,
             devices,
             tokens,
             is_loopback,
             [this](const std::string& wanted) { return free_name(wanted); },
             [this](std::string_view what, const std::string& address, std::string_view detail) {
               refused(what, address, detail);
             },
             std::move(programs)} {}

void Gateway::run_ready() {
  poller_.run_ready();
  feed_.publish(now_s_(), greeted() > 0);
}

void Gateway::tick() {
  const double now = now_s_();
  feed_.connect();
  for (const Client& client : clients_) client.session->tick(now);
  log_.tick(now);
}

std::size_t Gateway::greeted() const {
  return static_cast<std::size_t>(
      std::count_if(clients_.begin(), clients_.end(), [](const Client& c) { return c.session->is_greeted(); }));
}

bool Gateway::is_full() const { return greeted() >= kMaxClients; }

bool Gateway::lets_in(std::string_view ticket, std::string_view run) const {
  return house_.tokens == nullptr || std::any_of(clients_.begin(), clients_.end(), [&](const Client& client) {
           const std::string& whole = client.session->ticket();
           return !whole.empty() && same_in_constant_time(run.empty() ? whole : run_ticket(whole, run), ticket);
         });
}

std::string Gateway::metrics() const {
  const bool is_old = now_s_() - feed_.heard_s() > kOld_s;
  return metrics_text(is_old ? Json() : Json::parse_or_null(feed_.state()), greeted());
}

Session& Gateway::open(const std::string& address, std::function<void()> something_to_send) {
  if (clients_.size() - greeted() >= kMaxStrangers) drop_oldest_stranger();
  clients_.push_back({std::make_unique<Session>(house_, address, now_s_(), something_to_send), something_to_send});
  return *clients_.back().session;
}

void Gateway::drop_oldest_stranger() {
  for (const Client& client : clients_) {  // in the order in which they came
    if (client.session->is_greeted() || client.session->end().code != 0) continue;
    return client.session->close(kTryAgainLater, "too_many", "made room for others before it said hello");
  }
}

void Gateway::gone(const Session& session) {
  std::erase_if(clients_, [&](const Client& client) { return client.session.get() == &session; });
}

std::string Gateway::free_name(const std::string& wanted) const {
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(clients_.begin(), clients_.end(), [&](const Client& c) { return c.session->name() == name; });
  };
  std::string name = wanted;
  for (int i = 2; is_taken(name); ++i) name = wanted + "-" + std::to_string(i);
  return name;
}

void Gateway::wake_all() {
  for (const Client& client : clients_) client.wake();
}

void Gateway::refused(std::string_view what, const std::string& address, std::string_view detail) {
  log_.note(now_s_(), what, address, detail);
}

}  // namespace liana::gateway
