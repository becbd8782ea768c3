// What was refused, on standard error: one line each, in a form that a program can read. What goes on is told once a
// minute with its number: whoever can reach the port fills no disk.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "host/base/event/standing.hpp"

namespace liana::gateway {

// Lines `liana-gateway: refused WHAT from ADDRESS: DETAIL`; docs/reference/console-protocol.md lists WHAT.
class RefusalLog {
 public:
  static constexpr std::uint32_t kAtOnce = 3;         // of one kind from one address; then they are counted
  static constexpr std::size_t kLongestDetail = 160;  // bytes; what is no printable ASCII is shown as ?

  // `now_s`: any clock that never goes back.
  void note(double now_s, std::string_view what, std::string_view address, std::string_view detail);
  // A complaint of a library, with the same bounds: `liana-gateway: LIBRARY: DETAIL`.
  void complain(double now_s, const char* library, std::string_view detail);
  // Says how many lines were left out; to be called from time to time.
  void tick(double now_s);

 private:
  void say(double now_s, const std::string& what, std::string_view address, std::string_view detail);

  static constexpr std::uint64_t kMinute_ms = 60'000;
  event::Standing<std::string> standing_{{kMinute_ms, kMinute_ms}};
};

}  // namespace liana::gateway
