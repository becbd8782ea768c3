// One client of the console (docs/reference/console-protocol.md): what it says, what it is to be told, and what it may.
// Knows nothing of the web.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/apps/gateway/access.hpp"
#include "host/apps/gateway/feed.hpp"
#include "host/apps/gateway/handles.hpp"
#include "host/apps/gateway/planner.hpp"
#include "host/apps/gateway/practice.hpp"
#include "host/apps/gateway/requester.hpp"
#include "host/apps/gateway/stop_call.hpp"

namespace liana::gateway {

// What a gateway knows besides lianad.
struct Programs {
  std::string planner = {};   // path of `liana`
  std::string practice = {};  // socket of the bench that takes faults; empty: the arm is not simulated here
};

// What all sessions share; outlives them.
struct House {
  Poller& poller;
  Feed& feed;
  std::string api, devices;                                         // sockets of lianad
  const Tokens* tokens;                                             // nullptr: no proof is asked for
  bool is_loopback = false;                                         // the gateway listens there
  std::function<std::string(const std::string& wanted)> free_name;  // one that no other client has
  std::function<void(std::string_view what, const std::string& address, std::string_view detail)> refused;
  Programs programs = {};
};

// What is to be sent next; good until the session is asked again.
struct Outgoing {
  std::string_view bytes;
  bool is_binary = false;
};

class Session {
 public:
  static constexpr std::size_t kCredits = 4;               // records under way that the client has not answered
  static constexpr std::size_t kMaxAnswerBytes = 1 << 19;  // that the client does not read
  static constexpr std::size_t kMaxMessages = 50;          // between two ticks; the others wait
  static constexpr double kHelloPatience_s = 5.0;
  static constexpr double kSilent_s = 10.0;    // with all credits under way
  static constexpr double kMaxMalformed = 20;  // in ten seconds

  // `something_to_send` is told when next() may have something, when the session has ended, and when a client that had
  // said much may go on.
  Session(House& house, std::string address, double now_s, std::function<void()> something_to_send);

  void take_text(std::string_view text, double now_s);
  void take_binary(std::string_view bytes, double now_s);
  void refuse_oversized(double now_s);
  // The next message, if there is one.
  std::optional<Outgoing> next(double now_s);
  // Whether next() may have another, apart from credits and pace.
  bool has_more() const;
  // To be called ten times a second.
  void tick(double now_s);

  // Has said enough for now: nothing more is to be read before the next tick.
  bool has_said_much() const { return messages_ >= kMaxMessages; }
  bool is_greeted() const { return greeted_; }
  const std::string& name() const { return name_; }
  // What lets the client load recorded runs while it is connected; empty where no tokens are asked for.
  const std::string& ticket() const { return ticket_; }
  const std::string& address() const { return address_; }
  double since_s() const { return since_s_; }
  // Why the connection is to be closed; empty while it is not. `code`: of RFC 6455, section 7.4.
  struct End {
    std::uint16_t code = 0;
    std::string text;
  };
  const End& end() const { return end_; }
  void close(std::uint16_t code, std::string_view what, const std::string& text);

 private:
  void hello(const class Json& message);
  bool is_proven(const Json& message);
  void request(const Json& message, std::optional<std::int64_t> id, double now_s);
  void carry_out(std::optional<std::int64_t> id, const std::function<void()>& wanted);
  void choose(const Json& wanted);
  void plan(const Json& wanted, double now_s);
  void stop(const Json& message, std::optional<std::int64_t> id, double now_s);
  void pace(const Json& message);
  void malformed(double now_s, std::optional<std::int64_t> id, const std::string& why);
  void answer(const Json& message);
  bool take_news();
  bool take_event();
  std::optional<Outgoing> record(double now_s);
  std::string welcome() const;

  House& house_;
  std::string address_, name_, nonce_, ticket_;
  double since_s_;
  std::function<void()> something_to_send_;
  bool greeted_ = false;
  Access access_ = Access::kWatch;
  std::optional<StopCall> stop_;
  std::optional<Requester> client_, operator_;
  std::optional<Handles> handles_;
  std::optional<Planner> planner_;
  std::optional<Practice> practice_;
  End end_;

  std::deque<std::string> answers_;
  std::size_t answer_bytes_ = 0;
  std::string sending_;
  std::uint32_t life_ = 0;
  std::string away_;
  std::uint64_t next_event_ = 0;
  std::uint32_t facts_sent_ = 0, record_sent_ = 0;
  std::vector<std::uint32_t> in_flight_;
  double period_s_ = 0.0, record_s_ = -1.0, heard_s_;
  std::size_t messages_ = 0;  // since the last tick
  double malformed_ = 0.0, malformed_s_ = 0.0;
};

}  // namespace liana::gateway
