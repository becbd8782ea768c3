#include "host/apps/gateway/refusal_log.hpp"

#include <cstdio>

namespace liana::gateway {
namespace {

std::string shown(std::string_view detail) {
  std::string text(detail.substr(0, RefusalLog::kLongestDetail));
  for (char& c : text) {
    if (c < 0x20 || c > 0x7E) c = '?';
  }
  return text;
}

std::uint64_t ms(double now_s) { return static_cast<std::uint64_t>(now_s * 1000.0); }

}  // namespace

void RefusalLog::say(double now_s, const std::string& what, std::string_view address, std::string_view detail) {
  const std::string from = address.empty() ? what : what + " from " + shown(address);
  const std::string line = from + ": " + shown(detail);
  if (auto* counted = standing_.take(from, what, ms(now_s), kAtOnce)) {
    counted->what = line;
  } else {
    std::fprintf(stderr, "liana-gateway: %s\n", line.c_str());
  }
}

void RefusalLog::note(double now_s, std::string_view what, std::string_view address, std::string_view detail) {
  say(now_s, "refused " + std::string(what), address, detail);
}

void RefusalLog::complain(double now_s, const char* library, std::string_view detail) {
  say(now_s, library, "", detail.substr(0, detail.find_last_not_of('\n') + 1));
}

void RefusalLog::tick(double now_s) {
  for (const auto& entry : standing_.due(ms(now_s)))
    std::fprintf(stderr, "liana-gateway: %s (and %llu like it)\n", entry.what.c_str(),
                 static_cast<unsigned long long>(entry.times - 1));
}

}  // namespace liana::gateway
