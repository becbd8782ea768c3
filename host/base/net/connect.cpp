#include "host/base/net/connect.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace liana::api {

namespace {
constexpr useconds_t kRetry_us = 20000;
}  // namespace

UniqueFd connect_to(const std::string& option, const std::string& path, double timeout_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  for (;;) {
    UniqueFd fd = try_to_connect(path);
    if (fd.get() >= 0) return fd;
    if (std::chrono::steady_clock::now() >= deadline) {
      std::string text = "cannot reach lianad at " + path + ": " + std::strerror(errno);
      text.append("; is it running with ").append(option).append(" ").append(path).append("?");
      throw std::runtime_error(text);
    }
    ::usleep(kRetry_us);
  }
}

}  // namespace liana::api
