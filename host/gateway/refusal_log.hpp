// What was refused, on standard error: one line each, in a form that a program can read, and never more than a few a
// second.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace liana::gateway {

// Lines `liana-gateway: refused WHAT from ADDRESS: DETAIL`; docs/console-protocol.md lists WHAT.
class RefusalLog {
 public:
  static constexpr std::size_t kMostPerSecond = 20;
  static constexpr std::size_t kLongestDetail = 160;  // bytes; what is no printable ASCII is shown as ?

  // `now_s`: any clock that never goes back.
  void note(double now_s, std::string_view what, std::string_view address, std::string_view detail);
  // Says how many lines were left out, when the second is over.
  void tick(double now_s);

 private:
  double since_s_ = 0.0;  // begin of the second
  std::size_t told_ = 0, kept_back_ = 0;
};

}  // namespace liana::gateway
