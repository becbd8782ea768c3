// The hunt for the most expensive tick.
//
//   bench_worst search CASES SEED [FILE]    tries CASES cases, random ones and changed ones of the worst so far (at
//   first those in a
//                                           file), led by time; prints the worst
//   bench_worst random CASES SEED    counts every tick of random cases
//   bench_worst stored FILE          counts every tick of the cases in a file
//
// Time is only a guide: what a case costs is what callgrind counts of it (tests/benchmarks/callgrind.py), each case
// under the operation "tick".
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "tests/benchmarks/meter.hpp"
#include "tests/benchmarks/worst_cases.hpp"

namespace liana::worst {

using namespace cable;
namespace {

constexpr std::size_t kPool = 40;     // worst cases that are changed further
constexpr double kFresh = 0.15;       // share of cases that owe nothing to them
constexpr std::int32_t kRepeats = 9;  // of a tick that may be among the worst: the least of its times counts

cable::Outputs plain_tick(cable::Controller& controller, const cable::Inputs& inputs) {
  return controller.tick(inputs);
}

double time_ns(cable::Controller& controller, const cable::Inputs& inputs, cable::Outputs& outputs) {
  const auto start = std::chrono::steady_clock::now();
  outputs = controller.tick(inputs);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

// Least time of a tick from a copy of the controller.
double min_time_ns(const cable::Controller& controller, const cable::Inputs& inputs) {
  double min_ns = 1e300;
  for (std::int32_t i = 0; i < kRepeats; ++i) {
    cable::Controller copy = controller;
    cable::Outputs outputs;
    min_ns = std::min(min_ns, time_ns(copy, inputs, outputs));
  }
  return min_ns;
}

struct Found {
  Case one{};
  double ns = 0.0;
};

class Search {
 public:
  explicit Search(std::uint64_t seed) : random_(seed) {}

  void begin_with(const std::vector<Case>& cases) {
    for (const Case& one : cases) try_case(one);
  }
  void run(std::int64_t cases) {
    for (std::int64_t i = 0; i < cases; ++i) {
      const bool fresh = pool_.size() < kPool || random_.uniform(0.0, 1.0) < kFresh;
      try_case(fresh ? random_case(random_) : mutated(any(), any(), random_));
      if ((i + 1) % 1000 == 0)
        std::fprintf(stderr, "%lld cases, %lld ticks, worst %.0f ns\n", static_cast<long long>(i + 1),
                     static_cast<long long>(ticks_), pool_[0].ns);
    }
  }
  void print() const {
    std::printf("# %lld ticks tried\n", static_cast<long long>(ticks_));
    for (const Found& found : pool_) std::printf("# %.0f ns\n%s\n", found.ns, text_of(found.one).c_str());
  }

 private:
  const Case& any() {
    return pool_[static_cast<std::size_t>(random_.uniform(0.0, static_cast<double>(pool_.size())))].one;
  }

  void try_case(const Case& one) {
    const double enough_ns = pool_.size() < kPool ? 0.0 : pool_.back().ns;
    double worst_ns = 0.0;
    play(one, started(one, plain_tick), [&](cable::Controller& controller, const cable::Inputs& inputs) {
      ++ticks_;
      const cable::Controller before = controller;
      cable::Outputs outputs;
      const double first_ns = time_ns(controller, inputs, outputs);
      if (first_ns > worst_ns && first_ns > enough_ns)
        worst_ns = std::max(worst_ns, std::min(first_ns, min_time_ns(before, inputs)));
      return outputs;
    });
    keep({one, worst_ns});
  }

  // The pool is sorted, worst first, and holds no case twice.
  void keep(const Found& found) {
    if (pool_.size() == kPool && found.ns <= pool_.back().ns) return;
    if (std::any_of(pool_.begin(), pool_.end(), [&](const Found& other) { return other.one == found.one; })) return;
    pool_.insert(
        std::upper_bound(pool_.begin(), pool_.end(), found, [](const Found& a, const Found& b) { return a.ns > b.ns; }),
        found);
    if (pool_.size() > kPool) pool_.pop_back();
  }

  zhu2022::Random random_;
  std::vector<Found> pool_;
  std::int64_t ticks_ = 0;
};

void count(const std::vector<Case>& cases) {
  bench::Meter meter;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string name = "case_" + std::to_string(i);
    play(cases[i], started(cases[i], plain_tick), [&](cable::Controller& controller, const cable::Inputs& inputs) {
      cable::Outputs outputs;
      meter.once("tick", name, [&] {
        outputs = controller.tick(inputs);
        return outputs.tip_speed_m_s;
      });
      return outputs;
    });
  }
  meter.print();
}

std::vector<Case> random_cases(std::int64_t count, std::uint64_t seed) {
  zhu2022::Random random(seed);
  std::vector<Case> cases(static_cast<std::size_t>(count));
  for (Case& one : cases) one = random_case(random);
  return cases;
}

std::vector<Case> stored_cases(const char* path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(std::string("cases: cannot open ") + path);
  return read_cases(file);
}

std::int64_t number(std::string_view word) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value < 1) {
    throw std::invalid_argument("CASES and SEED are whole numbers from 1 on, not " + std::string(word));
  }
  return value;
}

// Numbers near zero take long on some processors and no instruction more: they are not to lead the search.
void flush_tiny_numbers() {
#ifdef __SSE2__
  _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

void run(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (what == "stored" && argc == 3) return count(stored_cases(argv[2]));
  if ((what != "search" && what != "random") || argc < 4 || argc > (what == "search" ? 5 : 4))
    throw std::invalid_argument("usage: bench_worst search CASES SEED [FILE] | random CASES SEED | stored FILE");
  const std::int64_t cases = number(argv[2]);
  const auto seed = static_cast<std::uint64_t>(number(argv[3]));
  if (what == "random") return count(random_cases(cases, seed));
  flush_tiny_numbers();
  Search search(seed);
  if (argc == 5) search.begin_with(stored_cases(argv[4]));
  search.run(cases);
  search.print();
}

}  // namespace
}  // namespace liana::worst

int main(int argc, char** argv) try {
  liana::worst::run(argc, argv);
  return 0;
} catch (const std::invalid_argument& error) {
  std::fprintf(stderr, "bench_worst: %s\n", error.what());
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_worst: %s\n", error.what());
  return 1;
}
