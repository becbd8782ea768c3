// The on-board end of the link to the ground: telecommands in, requests to lianad as any client makes them, telemetry
// out. Knows neither sockets nor clocks.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <string_view>

#include "host/apps/ground/downlink.hpp"
#include "host/apps/ground/execution.hpp"

namespace liana::ground {

struct OnBoardConfig {
  double silence_s = 10.0;             // without a telecommand for so long the link counts as lost; over 0
  std::size_t store_bytes = 64000000;  // of packets that can be sent again
};

class OnBoard {
 public:
  static constexpr std::size_t kMaxOpen = 64;        // telecommands that are not completed
  static constexpr std::size_t kResentAtOnce = 100;  // packets of each tick

  struct Ways {
    Downlink::Send send;                               // a packet to the ground
    std::function<bool(const Json& request)> request;  // to lianad; false: it is not there
    std::function<void()> leave;                       // ends the connection to lianad, which may be made again
  };
  OnBoard(const OnBoardConfig& config, Ways ways);

  // To be called before the others: a clock that never goes back [s], and the time in packets [us since 1970].
  void set_time(double now_s, std::uint64_t time_us);

  // One packet of a stream, or one datagram.
  void receive(std::string_view packet);
  // A stream in which no packet can be found any more.
  void lose_stream() { ++unreadable_; }
  // The last connection for telecommands has ended.
  void lose_connection() { lose_link(); }

  // lianad's welcome. Throws JsonError when its robot has no sizes.
  void welcome(const Json& message);
  // Any other message of it.
  void take(const Json& message);
  void controller_gone();

  // To be called ten times a second.
  void tick();

  const Sizes& sizes() const { return sizes_; }
  std::size_t open() const { return executions_.size(); }
  // Sequence of the newest event of lianad; 0: none yet.
  std::uint64_t last_event() const { return last_event_; }

 private:
  struct Periodic {
    bool is_on = false;
    std::uint32_t interval = 50;  // command intervals
    std::uint32_t passed = 0;
  };
  static constexpr std::size_t kStructures = 5;

  void route(const Telecommand& telecommand);
  Ending carry_out(const Telecommand& telecommand, const CommandRow& row);
  Ending housekeeping(const Telecommand& telecommand, const Json& values);
  Ending resend(const Telecommand& telecommand, const Json& values);
  Ending request(const Telecommand& telecommand, const CommandRow& row);
  void answer(const Json& message);
  void take_state(const Json& state);
  void take_event(const Json& event);
  void own_event(OwnEvent event, const std::string& more = "");
  void send_structure(std::size_t structure);
  void send_time();
  void count(const Telecommand& telecommand);
  void lose_link();
  void fail_all(Failure failure);
  void end_replaced(std::uint64_t by);
  void complete(const Execution& execution, const Ending& ending);
  void verify(const Telecommand& telecommand, std::uint8_t good_subtype, std::uint8_t asked, const Ending& ending);
  Json counters() const;

  OnBoardConfig config_;
  Ways ways_;
  Downlink downlink_;
  Sizes sizes_;
  Json state_;  // the newest; null while lianad is not there
  bool is_there_ = false;
  std::array<Periodic, kStructures> periodic_{};
  std::list<Execution> executions_;
  Telecommand resending_{};  // while resend_goes_on_
  bool resend_goes_on_ = false;
  double now_s_ = 0.0, heard_s_ = 0.0, time_sent_s_ = -1e9;
  std::uint64_t time_us_ = 0, next_id_ = 1, last_event_ = 0;
  std::uint8_t time_exponent_ = 3;
  std::map<std::uint16_t, std::uint16_t> last_counts_;  // by source
  std::uint64_t received_ = 0, rejected_ = 0, unreadable_ = 0, count_jumps_ = 0, links_lost_ = 0;
};

}  // namespace liana::ground
