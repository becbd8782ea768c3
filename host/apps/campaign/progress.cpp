#include "host/apps/campaign/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace liana::campaign {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLivePeriod = std::chrono::milliseconds(500);
constexpr auto kLinePeriod = std::chrono::seconds(10);

}  // namespace

Progress::Progress(std::uint64_t rows)
    : terminal_(isatty(STDERR_FILENO) == 1), rows_(rows), begin_(Clock::now()), next_(begin_) {}

Progress::~Progress() { clear_live(); }

void Progress::row_done(bool is_success) {
  ++done_;
  if (!is_success) ++failed_;
  if (Clock::now() >= next_ || done_ == rows_) show(done_ == rows_);
}

void Progress::say(const std::string& text) {
  clear_live();
  std::fprintf(stderr, "%s\n", text.c_str());
}

void Progress::show(bool is_last) {
  const auto now = Clock::now();
  next_ = now + (terminal_ ? Clock::duration(kLivePeriod) : Clock::duration(kLinePeriod));
  const double spent_s = std::chrono::duration<double>(now - begin_).count();
  const double left_s = spent_s / static_cast<double>(done_) * static_cast<double>(rows_ - done_);
  std::string line = std::to_string(done_) + " of " + std::to_string(rows_) + " rows";
  if (failed_ > 0) line += ", " + std::to_string(failed_) + " failed";
  line += is_last ? ", took " + duration_text(spent_s) : ", about " + duration_text(left_s) + " left";
  clear_live();
  live_ = terminal_ && !is_last;
  std::fprintf(stderr, live_ ? "%s" : "%s\n", line.c_str());
  std::fflush(stderr);
}

void Progress::clear_live() {
  if (live_) std::fprintf(stderr, "\r\x1b[K");
  live_ = false;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  char text[64];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole / 60 % 60);
  } else if (whole >= 60) {
    std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld s", whole);
  }
  return text;
}

}  // namespace liana::campaign
