// Counts instructions when run under callgrind and measures time otherwise: one program does both, on the same calls.
//
// Under callgrind (--collect-atstart=no) collection is on during a counted call only, and each call is dumped on its
// own with the label "operation version". Otherwise `print` writes one line of JSON for each label.
// tests/benchmarks/callgrind.py puts both together.
#pragma once

#include <valgrind/callgrind.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace liana::bench {

class Meter {
 public:
  // One call that cannot be repeated, such as a tick, or one among calls of very different cost. `call` returns a
  // number of its result.
  template <class Call>
  void once(const std::string& operation, const std::string& version, Call&& call) {
    const std::string label = operation + " " + version;
    if (RUNNING_ON_VALGRIND) {
      CALLGRIND_TOGGLE_COLLECT;
      sink_ = call();
      CALLGRIND_TOGGLE_COLLECT;
      CALLGRIND_DUMP_STATS_AT(label.c_str());
    } else {
      nanoseconds_[label].push_back(time_ns([&] { sink_ = call(); }));
    }
  }

  // `call(i)` for i = 0 .. calls - 1. Times are means over all calls, the least of several rounds: the steadiest figure
  // on a shared machine.
  template <class Call>
  void each(const std::string& operation, const std::string& version, std::size_t calls, Call&& call) {
    if (RUNNING_ON_VALGRIND) {
      for (std::size_t i = 0; i < calls; ++i) once(operation, version, [&] { return call(i); });
      return;
    }
    double min_ns = std::numeric_limits<double>::max();
    for (int round = 0; round < kRounds; ++round) {
      min_ns = std::min(min_ns, time_ns([&] {
                          for (std::size_t i = 0; i < calls; ++i) sink_ = call(i);
                        }));
    }
    nanoseconds_[operation + " " + version].push_back(min_ns / static_cast<double>(calls));
  }

  // One call consists of that many equal parts; the page shows one.
  void parts(const std::string& operation, const std::string& version, std::size_t count) {
    if (!RUNNING_ON_VALGRIND)
      std::printf("{\"label\": \"%s %s\", \"parts\": %zu}\n", operation.c_str(), version.c_str(), count);
  }

  // A remark on what was measured, for the page.
  void note(const std::string& operation, const std::string& version, const std::string& text) {
    if (!RUNNING_ON_VALGRIND)
      std::printf("{\"label\": \"%s %s\", \"note\": \"%s\"}\n", operation.c_str(), version.c_str(), text.c_str());
  }

  void print() {
    for (auto& [label, values] : nanoseconds_) {
      std::sort(values.begin(), values.end());
      std::printf("{\"label\": \"%s\", \"median_ns\": %.1f}\n", label.c_str(), values[values.size() / 2]);
    }
  }

 private:
  static constexpr int kRounds = 9;

  template <class Call>
  static double time_ns(Call&& call) {
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
  }

  std::map<std::string, std::vector<double>> nanoseconds_;
  volatile double sink_ = 0.0;  // keeps results alive
};

}  // namespace liana::bench
