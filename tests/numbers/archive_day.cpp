// An archive of `--count` seconds (86,400: a day) in accelerated time, of an arm that always moves: 120 numbers at 50
// Hz, of which a third is commanded, a third measured with noise, a third counted; 50 commands a second, an event every
// ten. Ends with exit code 1 when anything is missing, not whole, or a day of telemetry would take more than
// kMost_bytes.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "host/base/json/json.hpp"
#include "host/storage/archive/check.hpp"
#include "host/storage/archive/ledger.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/segments.hpp"
#include "host/storage/archive/telemetry_files.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kPeriod_s = 0.004;
constexpr std::uint64_t kInterval = 5, kSecond = 250;
constexpr std::size_t kFields = 120, kPlotted = 64;  // of these, those that have figures by the second
constexpr double kDay_s = 86400.0, kMost_bytes = 1.0e9;
constexpr int kMinutes = 200;  // that are read again

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

Json layout() {
  return {{"version", 1},
          {"bytes", 24 + 4 * kFields},
          {"fields",
           {{{"name", "node_m"}, {"unit", "m"}, {"offset", 24}, {"count", kFields - kPlotted}},
            {{"name", "tension_N"}, {"unit", "N"}, {"offset", 24 + 4 * (kFields - kPlotted)}, {"count", kPlotted}}}}};
}

class Source {
 public:
  // What telemetry looks like: joint angles and lengths that go on smoothly, readings that scatter by a thousandth,
  // counters.
  std::string record(std::uint32_t number, std::uint64_t tick) {
    const double time_s = static_cast<double>(tick) * kPeriod_s;
    std::string out(24 + 4 * kFields, '\0');
    put(out, 0, number);
    put(out, 4, std::uint32_t{1});
    put(out, 8, static_cast<double>(tick));
    put(out, 16, time_s);
    for (std::size_t i = 0; i < kFields; ++i) put(out, 24 + 4 * i, static_cast<float>(value(i, time_s)));
    return out;
  }

 private:
  template <class T>
  static void put(std::string& out, std::size_t at, T value) {
    std::memcpy(out.data() + at, &value, sizeof value);
  }
  double value(std::size_t i, double time_s) {
    const double smooth = 10.0 * std::sin(time_s * (0.1 + 0.01 * static_cast<double>(i)) + static_cast<double>(i));
    if (i % 3 == 0) return smooth;
    if (i % 3 == 1) return smooth + 0.001 * noise_(generator_);
    return std::floor(time_s * static_cast<double>(i));
  }
  std::mt19937_64 generator_{1};
  std::normal_distribution<double> noise_;
};

struct Written {
  double seconds = 0.0;
  std::uint64_t gaps = 0;
};

Written write_archive(const std::string& folder, std::uint64_t seconds) {
  const auto begin = Clock::now();
  Written written;
  archive::Ledger ledger(folder);
  const std::uint64_t life = ledger.begin({"hash", "{}", "{}", "{}", "fast", kPeriod_s, "", "numbers"}).life;
  ledger.set_layout(layout());
  archive::TelemetryFiles telemetry(
      folder, life, kPeriod_s, {}, [&](const archive::Gap&) { ++written.gaps; }, [](std::uint64_t) {});
  telemetry.set_layout(telemetry::layout_from(layout()));
  Source source;
  std::uint32_t number = 0;
  for (std::uint64_t tick = 0; tick < seconds * kSecond; tick += kInterval) {
    if (tick % (10 * kSecond) == 0) {
      ledger.add(event::Event{.kind = event::EventKind::kStep, .sequence = tick / 2500 + 1, .tick = tick});
      telemetry.set_facts({tick, static_cast<std::uint32_t>(tick / 2500 + 1), Json{{"state", "ENABLED"}}});
    }
    ledger.add(archive::Command{++number, tick, true, 0, 0.5});
    telemetry.add(tick, source.record(number, tick));
    if (tick % kSecond == 0 && !ledger.commit()) ++written.gaps;
  }
  telemetry.finish();
  ledger.commit();
  ledger.finish();
  written.seconds = seconds_since(begin);
  return written;
}

struct Minutes {
  double median_ms = 0.0, worst_ms = 0.0;
  bool all_there = true;
};

// Each by a reader of its own: nothing is kept from one to the next but what the system keeps.
Minutes read_minutes(const std::string& folder, std::uint64_t seconds) {
  std::mt19937_64 generator(2);
  std::vector<double> took_ms;
  Minutes minutes;
  const std::uint64_t length_s = std::min<std::uint64_t>(60, seconds);
  for (int i = 0; i < kMinutes; ++i) {
    const double from_s = static_cast<double>(generator() % (seconds - length_s + 1));
    const auto begin = Clock::now();
    const archive::Reader reader(folder);
    const auto records = reader.telemetry(reader.span_of(from_s, from_s + static_cast<double>(length_s) - 0.02));
    took_ms.push_back(seconds_since(begin) * 1e3);
    minutes.all_there = minutes.all_there && records.size() == 50 * length_s;
  }
  std::sort(took_ms.begin(), took_ms.end());
  minutes.median_ms = took_ms[took_ms.size() / 2];
  minutes.worst_ms = took_ms.back();
  return minutes;
}

int run(const Options& options) {
  const auto seconds = static_cast<std::uint64_t>(options.count);
  const std::string folder = fs::temp_directory_path() / ("liana-archive-day-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const Written written = write_archive(folder, seconds);
  const Minutes minutes = read_minutes(folder, seconds);
  const archive::Check check = archive::check(folder);
  const std::uint64_t telemetry = archive::bytes_of(archive::segments_in(folder));
  fs::remove_all(folder);
  const archive::LifeCheck life = check.lives.empty() ? archive::LifeCheck{} : check.lives[0];
  const double day = kDay_s / static_cast<double>(seconds), bytes_a_day = static_cast<double>(telemetry) * day;
  const bool good = check.problems.empty() && minutes.all_there && written.gaps == 0 && life.gaps.empty() &&
                    life.records == 50 * seconds && life.commands == 50 * seconds && bytes_a_day <= kMost_bytes;
  const Json result{{"seconds", seconds},
                    {"records", life.records},
                    {"commands", life.commands},
                    {"whole", check.problems.empty()},
                    {"gaps", written.gaps},
                    {"telemetry_bytes_a_day", bytes_a_day},
                    {"all_bytes_a_day", static_cast<double>(check.bytes) * day},
                    {"written_in_s", written.seconds},
                    {"minute_median_ms", minutes.median_ms},
                    {"minute_worst_ms", minutes.worst_ms},
                    {"good", good}};
  std::puts(result.dump(options.json ? -1 : 1).c_str());
  return good ? 0 : 1;
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) { return liana::numbers::run(liana::numbers::parse_options(argc, argv, 86400)); }
