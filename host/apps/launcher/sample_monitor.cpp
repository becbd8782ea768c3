#include "host/apps/launcher/sample_monitor.hpp"

#include <algorithm>

#include "host/base/json/json.hpp"

namespace liana::launcher {
namespace {

Json figures(std::vector<double> ages_s, double worst_s) {
  if (ages_s.empty()) return nullptr;
  std::sort(ages_s.begin(), ages_s.end());
  return {{"median", ages_s[ages_s.size() / 2]}, {"worst", worst_s}};
}

}  // namespace

void SampleMonitor::look(const Json& state) {
  const Json& rate = state.member_or_null("device_rate");
  if (!rate.is_object()) return;
  OfDevice& device = devices_[state.value("device", "")];
  look_at_rate(rate, device);
  look_at_command(state.member_or_null("verdict"), device);
}

// Of a use: each begins anew.
void SampleMonitor::look_at_rate(const Json& rate, OfDevice& device) {
  const double least_s = rate.value("min_s", 0.0);
  if (least_s > 0.0) device.least_s = device.least_s > 0.0 ? std::min(device.least_s, least_s) : least_s;
  device.most_s = std::max(device.most_s, rate.value("max_s", 0.0));
  const Json& hz = rate.member_or_null("hz");
  if (hz.is_number()) slowest_hz_ = std::min(slowest_hz_.value_or(hz.get<double>()), hz.get<double>());
}

void SampleMonitor::look_at_command(const Json& verdict, OfDevice& device) {
  const Json& source_stamp = verdict.member_or_null("source_stamp");
  if (!source_stamp.is_object()) return;
  const auto command = verdict.value("sequence", std::uint64_t{0});
  if (command == command_) return;
  command_ = command;
  const double newest_s = 1e-6 * source_stamp.value("newest_us", 0.0),
               oldest_s = 1e-6 * source_stamp.value("oldest_us", 0.0);
  const double middle_s = 0.5 * (newest_s + oldest_s);
  const double released_s = source_stamp.value("released_s", 0.0), in_force_s = source_stamp.value("in_force_s", 0.0);
  device.to_release_s.push_back(released_s - middle_s);
  device.in_force_s.push_back(in_force_s - middle_s);
  device.worst_release_s = std::max(device.worst_release_s, released_s - oldest_s);
  device.worst_in_force_s = std::max(device.worst_in_force_s, in_force_s - oldest_s);
}

Json SampleMonitor::json() const {
  Json out;
  for (const auto& [name, device] : devices_) {
    out[name] = {{"interval_s", {{"least", device.least_s}, {"most", device.most_s}}},
                 {"to_release_s", figures(device.to_release_s, device.worst_release_s)},
                 {"in_force_s", figures(device.in_force_s, device.worst_in_force_s)}};
  }
  return out;
}

}  // namespace liana::launcher
