// Which telemetry is missing on the ground, by sequence counts, and when to ask for it again. Reads no clock.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
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
  static constexpr std::size_t kMaxGaps = 1024;  // at a time; further ones count as lost

  struct Span {
    std::uint64_t from_us = 0, to_us = 0;
  };

  // The newest packet that the store has from before; without it the first one is the beginning.
  void begin(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us);
  // A packet has come, for the first time or again.
  void take(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us, double now_s);
  // The span of time to ask for now, if there is one.
  std::optional<Span> ask(double now_s);

  std::uint64_t found() const { return found_; }    // packets that were missing
  std::uint64_t filled() const { return filled_; }  // of these, came again or late
  std::uint64_t lost() const { return lost_; }      // were given up
  std::size_t open() const { return gaps_.size(); }

 private:
  struct Newest {
    std::uint16_t count;
    std::uint64_t time_us;
  };
  struct Gap {
    std::uint16_t apid;
    std::set<std::uint16_t> missing;
    Span span;
    double next_s;
    int tries = 0;
  };
  bool fill(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us);

  std::map<std::uint16_t, Newest> newest_;  // by APID
  std::deque<Gap> gaps_;
  std::uint64_t found_ = 0, filled_ = 0, lost_ = 0;
};

}  // namespace liana::ground
