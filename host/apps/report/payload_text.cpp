#include "host/apps/report/payload_text.hpp"

#include <cstdio>

#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

// `format` with the figure times `scale`; empty where it was not reached.
std::string words(const Json& report, const char* figure, const char* format, double scale = 1.0) {
  const Json& value = report.member_or_null(figure);
  if (!value.is_number()) return "";
  char text[80];
  std::snprintf(text, sizeof text, format, scale * value.get<double>());
  return text;
}

std::string line_of(const std::string& begin, const std::string& rest) {
  return begin.empty() ? "" : begin + rest + "\n";
}

}  // namespace

std::string payload_text(const Json& report) {
  return line_of(words(report, "servo_error_m", "servo %.2f mm", 1e3) + words(report, "servo_error_deg", ", %.2f deg"),
                 words(report, "settling_s", ", settled after %.1f s") +
                     words(report, "lateral_sway_m", ", sway %.2f mm", 1e3)) +
         line_of(words(report, "force_N", "force %.1f N"), words(report, "force_rise_s", " after %.1f s") +
                                                               words(report, "peak_force_N", " (hardest %.1f N)") +
                                                               words(report, "insertion_m", ", %.1f mm in", 1e3) +
                                                               words(report, "unload_s", ", unloaded %.2f s later")) +
         line_of(words(report, "peak_joint_torque_Nm", "joint torque %.1f N m at most meanwhile"),
                 words(report, "base_deflection_m", ", base gives way %.1f mm", 1e3) +
                     words(report, "load_duration_s", ", under load for %.1f s")) +
         line_of(words(report, "resisted_N", "overcame %.1f N"), words(report, "margin_N", ", with %.1f N to spare"));
}

}  // namespace liana::report
