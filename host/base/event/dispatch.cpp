#include "host/base/event/dispatch.hpp"
#include "host/base/text/printable.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace liana::event {
namespace {

constexpr std::array<const char*, kStages> kStageNames{"setpoint", "execution", "simulation", "release",
                                                       "start",    "complete",  "refusal",    "request"};
static_assert(static_cast<std::size_t>(Stage::kRequest) + 1 == kStages);
constexpr std::size_t kColumns = 8;

std::string figure(double value) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string margins_text(const std::array<double, kMargins>& margins) {
  std::string out;
  for (const double margin : margins) out += (out.empty() ? "" : " ") + figure(margin);
  return out;
}

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(mark);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <class Number>
bool read(std::string_view text, Number& out) {
  if (text.empty()) return true;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc() && end == text.data() + text.size();
}

bool read_margins(std::string_view text, Dispatch& out) {
  if (text.empty()) return true;
  const std::vector<std::string_view> parts = split(text, ' ');
  if (parts.size() != kMargins) return false;
  std::array<double, kMargins>& margins = out.margins.emplace();
  for (std::size_t i = 0; i < kMargins; ++i) {
    if (parts[i] == "-") {
      margins[i] = std::numeric_limits<double>::quiet_NaN();
    } else if (!read(parts[i], margins[i])) {
      return false;
    }
  }
  return true;
}

}  // namespace

const char* stage_name(Stage stage) { return kStageNames[static_cast<std::size_t>(stage)]; }

const char* const kDispatchHeading =
    "tick\tstage\tcommand\tnumber\tsubject\tshare\tclearance_m joint_deg rate_deg_s tension_N time_us\ttext";

std::string dispatch_line(const Dispatch& d) {
  const std::string command = d.command == 0 ? "" : std::to_string(d.command);
  const std::string number = d.number == 0 ? "" : std::to_string(d.number);
  return std::to_string(d.tick) + "\t" + stage_name(d.stage) + "\t" + command + "\t" + number + "\t" +
         text::printable(d.subject, text::Lines::kOne, ' ') + "\t" + (d.share == 0.0 ? "" : figure(d.share)) + "\t" +
         (d.margins ? margins_text(*d.margins) : "") + "\t" + text::printable(d.text, text::Lines::kOne, ' ');
}

std::optional<Dispatch> dispatch_from_line(std::string_view line) {
  const std::vector<std::string_view> column = split(line, '\t');
  if (column.size() != kColumns || column[0].empty()) return std::nullopt;
  Dispatch d;
  const auto stage = std::find(kStageNames.begin(), kStageNames.end(), column[1]);
  if (stage == kStageNames.end()) return std::nullopt;
  d.stage = static_cast<Stage>(stage - kStageNames.begin());
  const bool good = read(column[0], d.tick) && read(column[2], d.command) && read(column[3], d.number) &&
                    read(column[5], d.share) && read_margins(column[6], d);
  if (!good) return std::nullopt;
  d.subject = column[4];
  d.text = column[7];
  return d;
}

}  // namespace liana::event
