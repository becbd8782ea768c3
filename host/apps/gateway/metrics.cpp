#include "host/apps/gateway/metrics.hpp"

#include <string_view>

#include "firmware_like/safety/supervisor.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {
namespace {

std::string label(std::string_view name, std::string_view value) {
  std::string text = std::string(name) + "=\"";
  for (const char c : value) {
    if (c == '\\' || c == '"') text += '\\';
    text += c == '\n' ? ' ' : c;
  }
  return text + '"';
}

class Metrics {
 public:
  // Begins a metric; its samples follow.
  void begin(std::string_view name, std::string_view type, std::string_view help) {
    name_ = "liana_" + std::string(name);
    text_ += "# HELP " + name_ + " " + std::string(help) + "\n# TYPE " + name_ + " " + std::string(type) + "\n";
  }
  void sample(const Json& value, const std::string& labels = "", double per_unit = 1.0) {
    if (!value.is_number()) return;
    text_ += name_ + (labels.empty() ? "" : "{" + labels + "}") + " " +
             (per_unit == 1.0 ? value : Json(value.get<double>() * per_unit)).dump() + "\n";
  }
  void one(std::string_view name, std::string_view type, std::string_view help, const Json& value,
           double per_unit = 1.0) {
    if (!value.is_number()) return;
    begin(name, type, help);
    sample(value, "", per_unit);
  }
  const std::string& text() const { return text_; }

 private:
  std::string name_, text_;
};

void add_faults(Metrics& out, const Json& faults) {
  out.one("faults", "gauge", "Latched faults.", Json(static_cast<std::uint64_t>(faults.size())));
  out.begin("fault", "gauge", "1 for each latched fault.");
  for (const Json& fault : faults) {
    out.sample(1, label("number", std::to_string(fault.value("number", std::int64_t{0}))) + "," +
                      label("name", fault.value("name", "")) + "," + label("where", fault.value("where", "")));
  }
}

void add_tensions(Metrics& out, const Json& tension_N) {
  out.begin("tension_newtons", "gauge", "Tension of each cable, as measured.");
  std::size_t number = 0;
  for (const Json& each : tension_N) out.sample(each, label("cable", std::to_string(++number)));
}

void add_buses(Metrics& out, const Json& buses) {
  const auto each = [&](const char* member) {
    for (const Json& bus : buses) out.sample(bus.member_or_null(member), label("bus", bus.value("name", "")));
  };
  out.begin("bus_load_ratio", "gauge", "Share of the bus time that frames take.");
  each("measured_load");
  out.begin("bus_errors_total", "counter", "Error frames of the bus.");
  each("errors");
}

}  // namespace

std::string metrics_text(const Json& state, std::size_t clients) {
  Metrics out;
  out.one("up", "gauge", "1 while lianad sends states.", Json(state.is_object() ? 1 : 0));
  out.one("gateway_clients", "gauge", "Consoles that are connected.", Json(static_cast<std::uint64_t>(clients)));
  if (!state.is_object()) return out.text();
  const std::string name = state.value("state", "");
  out.begin("state", "gauge", "1 for the state of the arm, 0 for the others.");
  for (const std::string_view each : kOperatingStateNames) out.sample(each == name ? 1 : 0, label("state", each));
  out.one("arm_time_seconds", "gauge", "Time of the arm.", state.member_or_null("time_s"));
  constexpr double kMicro = 1e-6;
  out.one("tick_seconds", "gauge", "Longest control tick of the last second.", state.member_or_null("tick_us"), kMicro);
  out.one("overruns_total", "counter", "Control ticks that came too late.", state.member_or_null("overruns"));
  out.one("refusals_total", "counter", "Commands that verification refused.", state.member_or_null("refusals"));
  out.one("clearance_meters", "gauge", "Distance between arm and scene.",
          state.member_or_null("clearance").member_or_null("distance_m"));
  add_faults(out, state.member_or_null("faults"));
  if (const Json& tension_N = state.member_or_null("tension_N"); tension_N.is_array()) add_tensions(out, tension_N);
  add_buses(out, state.member_or_null("buses"));
  return out.text();
}

}  // namespace liana::gateway
