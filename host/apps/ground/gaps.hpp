// Which telemetry is missing on the ground, by sequence counts, and when to ask for it again. Reads no clock.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "host/api/ground/packet.hpp"

namespace liana::ground {

// The time of a packet: of its secondary header, or what a time packet says.
std::uint64_t time_of(const Telemetry& telemetry);

class Gaps {
 public:
  static constexpr double kGrace_s = 1.0;        // packets may overtake each other for so long
  static constexpr double kAgain_s = 5.0;        // from one question to the next
  static constexpr int kMaxTries = 10;           // then what is missing counts as lost
  static constexpr std::size_t kMaxGaps = 1024;  // at a time; the oldest of more counts as lost

  struct Span {
    std::uint64_t from_us = 0, to_us = 0;
  };

  // A packet has come, for the first time or again. The first one is the beginning; so is one of an on-board end that
  // was started anew, which counts from 0: what the one before has sent last, and nobody got, is nowhere any more.
  void take(const Telemetry& packet, double now_s);
  // Packets of one time, in whatever order.
  void take_together(std::vector<Telemetry> packets, double now_s);
  // The span of time to ask for now, if there is one.
  std::optional<Span> ask(double now_s);

  std::uint64_t found() const { return found_; }    // packets that were missing
  std::uint64_t filled() const { return filled_; }  // of these, came again or late
  std::uint64_t lost() const { return lost_; }      // were given up
  std::size_t open() const { return gaps_.size(); }

 private:
  struct Gap;
  struct Newest {
    std::uint16_t count;
    std::uint64_t time_us;
  };
  struct Message {  // the newest of a service and subtype
    std::uint16_t count, message_count;
  };
  struct Gap {
    std::uint16_t apid;
    std::set<std::uint16_t> missing;
    Span span;
    double next_s;
    int tries = 0;
  };
  bool fill(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us);
  unsigned ahead(const Telemetry& packet) const;
  bool is_of_a_new_life(const Telemetry& packet, const Newest& before) const;
  void add(Gap gap);
  void begin_life(std::uint16_t apid, const Span& between, double now_s);

  std::map<std::uint16_t, Newest> newest_;                                   // by APID
  std::map<std::pair<std::uint8_t, std::uint8_t>, Message> newest_message_;  // by service and subtype
  std::deque<Gap> gaps_;
  std::uint64_t found_ = 0, filled_ = 0, lost_ = 0;
};

}  // namespace liana::ground
