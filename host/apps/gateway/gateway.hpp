// The clients of one gateway, and what they share. Knows nothing of the web: docs/reference/console-protocol.md from
// the second message on.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/apps/gateway/access.hpp"
#include "host/apps/gateway/feed.hpp"
#include "host/apps/gateway/poller.hpp"
#include "host/apps/gateway/refusal_log.hpp"
#include "host/apps/gateway/session.hpp"

namespace liana::gateway {

class Gateway {
 public:
  static constexpr std::size_t kMaxClients = 32;    // that have said hello
  static constexpr std::size_t kMaxStrangers = 16;  // that have not; the oldest makes room for another

  // `api`, `devices`: sockets of lianad, which need not be there yet. `tokens` (nullptr: none asked for) must outlive
  // this. `now_s`: any clock that never goes back.
  Gateway(const std::string& api, const std::string& devices, const Tokens* tokens, bool is_loopback,
          std::function<double()> now_s, Programs programs = {});

  // What the gateway waits for besides clients; its owner may add to it.
  Poller& poller() { return poller_; }
  // To be called when the poller's descriptor is readable.
  void run_ready();
  // To be called ten times a second.
  void tick();

  bool is_full() const;
  // Whether who shows this may load the page of a run, or (no `run`) the list of runs and the metrics: by the ticket of
  // a client that is connected, or what run_ticket() makes of it; anybody may where no tokens are asked for.
  bool lets_in(std::string_view ticket, std::string_view run) const;
  // The newest state and the number of clients as Prometheus reads them.
  std::string metrics() const;
  // A client has connected; `something_to_send` is told when next() may have something.
  Session& open(const std::string& address, std::function<void()> something_to_send);
  // It is gone; so are its connections to lianad, which holds the arm if it was its owner.
  void gone(const Session& session);

  double now_s() const { return now_s_(); }
  void refused(std::string_view what, const std::string& address, std::string_view detail);
  // What a library complains about, for the log.
  void complain(const char* library, std::string_view line) { log_.complain(now_s_(), library, line); }

 private:
  std::size_t greeted() const;
  std::string free_name(const std::string& wanted) const;
  void drop_oldest_stranger();
  void wake_all();

  std::function<double()> now_s_;
  RefusalLog log_;
  Poller poller_;
  Feed feed_;
  House house_;
  struct Client {
    std::unique_ptr<Session> session;
    std::function<void()> wake;
  };
  std::vector<Client> clients_;
};

}  // namespace liana::gateway
