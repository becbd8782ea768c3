#include "host/apps/report/latency_report.hpp"

#include <array>
#include <bit>
#include <cmath>

#include "host/apps/report/line.hpp"
#include "host/base/event/fault_groups.hpp"
#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

constexpr std::size_t kBins = 13;  // the last one: 2048 us or more, which lianad counts together
constexpr double kBarLength = 50.0;

std::string range_of(std::size_t bin) {
  if (bin < 2) return std::to_string(bin);
  if (bin == kBins - 1) return std::to_string(1u << (bin - 1)) + " or more";
  return std::to_string(1u << (bin - 1)) + " to " + std::to_string((1u << bin) - 1);
}

std::string row(const char* name, const Json& times) {
  return line("  %-10s %8u %8u %8u\n", name, times.value("median", 0u), times.value("p99", 0u),
              times.value("worst", 0u));
}

// Each kind of fault once: a starved machine loses all drives at a time.
std::string faults_text(const Json& faults) {
  std::string text;
  for (const event::FaultGroup& group : event::fault_groups(faults))
    text += "  fault " + group.alarm() + ": " + group.text + "\n";
  return text;
}

std::string verdict(const Json& report) {
  const double period_us = 1e6 / report.value("rate_hz", 0.0);
  const double wakeup = report["wakeup_us"].value("worst", 0.0), tick = report["tick_us"].value("worst", 0.0);
  std::string text = line("worst wake-up %.1f %% of the period of %.0f us, longest tick %.1f %%\n",
                          100.0 * wakeup / period_us, period_us, 100.0 * tick / period_us);
  const Json& causes = report["overrun_causes"];
  if (report.value("overruns", 0u) == 0) {
    text += "no deadline was missed\n";
  } else {
    text += line("DEADLINES MISSED: %u (woke up late %u, tick too long %u, bus kept it waiting %u), %u ticks lost\n",
                 report.value("overruns", 0u), causes.value("late_wake", 0u), causes.value("long_tick", 0u),
                 causes.value("bus_wait", 0u), causes.value("lost_ticks", 0u));
  }
  if (!report.value("enabled", false))
    text += "THE ARM WAS NOT ENABLED ALL THE TIME: these are not the ticks of an arm at work\n";
  text += line("the arm moved for %.0f %% of the time\n", 100.0 * report.value("moving", 0.0));
  return text + faults_text(report["faults"]);
}

std::string missing(const Json& findings) {
  std::string text;
  for (const Json& finding : findings) {
    if (finding.value("good", false)) continue;
    text += "  " + finding.value("name", "") + ": " + finding.value("found", "") +
            "\n    to do: " + finding.value("action", "") + "\n";
  }
  return text.empty() ? "the machine has what --time real asks for (liana doctor)\n"
                      : "what the machine lacks for --time real:\n" + text;
}

}  // namespace

Json latency_report(const LatencyMeasurement& measured, const config::BusesConfig& buses, double seconds,
                    const std::vector<Finding>& realtime) {
  Json report = measured.timing;
  report.erase("op");
  report.erase("id");
  report["rate_hz"] = buses.rate_hz;
  report["buses"] = buses.name;
  report["seconds"] = seconds;
  report["enabled"] = measured.enabled;
  report["moving"] = measured.moving;
  report["faults"] = measured.last_state.value("faults", Json::array());
  report["realtime"] = findings_json(realtime);
  return report;
}

std::string histogram_text(const Json& buckets) {
  std::array<std::uint64_t, kBins> count{};
  for (const Json& bucket : buckets) {
    const auto bin = static_cast<std::size_t>(std::bit_width(bucket[0].get<std::uint64_t>()));
    count[std::min(bin, kBins - 1)] += bucket[1].get<std::uint64_t>();
  }
  std::size_t first = 0, last = kBins;
  while (first < last && count[first] == 0) ++first;
  while (last > first && count[last - 1] == 0) --last;
  double longest = 0.0;
  for (const std::uint64_t each : count) longest = std::max(longest, std::log1p(static_cast<double>(each)));
  std::string text;
  for (std::size_t bin = first; bin < last; ++bin) {
    const double share = count[bin] == 0 ? 0.0 : std::log1p(static_cast<double>(count[bin])) / longest;
    const std::string bar(static_cast<std::size_t>(std::lround(kBarLength * share)), '#');
    text += line("  %14s %9llu %s\n", range_of(bin).c_str(), static_cast<unsigned long long>(count[bin]), bar.c_str());
  }
  return text;
}

std::string latency_text(const Json& report) {
  std::string text = line("%g Hz (buses %s), %g s, %llu ticks; times in us\n", report.value("rate_hz", 0.0),
                          report.value("buses", "").c_str(), report.value("seconds", 0.0),
                          static_cast<unsigned long long>(report.value("ticks", std::uint64_t{0})));
  text += line("  %-10s %8s %8s %8s\n", "", "median", "p99", "worst");
  text += row("wake-up", report["wakeup_us"]) + row("tick", report["tick_us"]);
  text += "wake-up after the deadline, us (bars logarithmic)\n" + histogram_text(report["wakeup_us"]["buckets"]);
  text += "the tick's own work, us\n" + histogram_text(report["tick_us"]["buckets"]);
  return text + verdict(report) + missing(report["realtime"]);
}

}  // namespace liana::report
