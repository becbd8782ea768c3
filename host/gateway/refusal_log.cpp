#include "host/gateway/refusal_log.hpp"

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

}  // namespace

void RefusalLog::note(double now_s, std::string_view what, std::string_view address, std::string_view detail) {
  tick(now_s);
  if (told_ == kMostPerSecond) {
    ++kept_back_;
    return;
  }
  ++told_;
  std::fprintf(stderr, "liana-gateway: refused %s from %s: %s\n", std::string(what).c_str(), shown(address).c_str(),
               shown(detail).c_str());
}

void RefusalLog::tick(double now_s) {
  if (now_s - since_s_ < 1.0) return;
  if (kept_back_ > 0) std::fprintf(stderr, "liana-gateway: refused %zu more\n", kept_back_);
  since_s_ = now_s;
  told_ = kept_back_ = 0;
}

}  // namespace liana::gateway
