#include "host/apps/launcher/progress.hpp"

#include <unistd.h>

#include <cstdio>

#include "host/base/json/json.hpp"

namespace liana::launcher {
namespace {
constexpr double kLivePeriod_s = 0.5;  // of arm time
}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::say(const std::string& text) {
  clear_live();
  std::fprintf(stderr, "%s\n", text.c_str());
}

void Progress::show(const Json& state) {
  const double time_s = state.value("time_s", 0.0);
  char stamp[32];
  std::snprintf(stamp, sizeof stamp, "%7.1f s  ", time_s);
  const std::string phase = state.value("state", "");
  if (phase != phase_) {
    phase_ = phase;
    say(stamp + phase);
  }
  const auto step = state.find("step");
  const std::int64_t entry = step != nullptr && step->is_object() ? step->value("entry", std::int64_t{0}) : 0;
  if (step != nullptr && step->is_object() && (step->value("index", 0) != step_index_ || entry != step_entry_)) {
    step_index_ = step->value("index", 0);
    step_entry_ = entry;
    say(stamp + ("step " + std::to_string(step_index_)) + ": " + step->value("name", "") + " (" +
        step->value("device", "none") + ")");
  }
  if (terminal_ && time_s >= next_live_s_) show_live(state);
}

void Progress::show_live(const Json& state) {
  next_live_s_ = state.value("time_s", 0.0) + kLivePeriod_s;
  const auto tip = state.find("measured_cp");
  if (tip == nullptr || tip->size() != 7) return;
  dprintf(STDERR_FILENO, "\r\x1b[K%7.1f s  step %d, tip at %.3f %.3f %.3f m", state.value("time_s", 0.0), step_index_,
          (*tip)[0].get<double>(), (*tip)[1].get<double>(), (*tip)[2].get<double>());
  live_ = true;
}

void Progress::clear_live() {
  if (live_) dprintf(STDERR_FILENO, "\r\x1b[K");
  live_ = false;
}

}  // namespace liana::launcher
