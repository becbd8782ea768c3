#include "host/apps/launcher/health_check.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <utility>

namespace liana::launcher {

HealthCheck::HealthCheck(api::InternetAddress at, double now_s) : at_(std::move(at)) { restart(now_s); }

void HealthCheck::restart(double now_s) {
  socket_ = api::UniqueFd();
  asked_s_ = looked_s_ = now_s;
  silent_s_ = 0.0;
}

double HealthCheck::silent_s(double now_s) {
  silent_s_ += std::min(now_s - std::exchange(looked_s_, now_s), kLongestStep_s);
  if (socket_.get() >= 0)
    look();
  else if (now_s - asked_s_ >= kBetween_s)
    ask(now_s);
  return silent_s_;
}

// A question waits until it is answered: a machine that is late with one would be late with the next.
void HealthCheck::ask(double now_s) {
  asked_s_ = now_s;
  is_sent_ = false;
  socket_ = api::connect_at(api::Transport::kTcp, at_);
  if (socket_.get() < 0 && errno != ECONNREFUSED) heard();  // this program lacks descriptors or memory
}

void HealthCheck::look() {
  pollfd now{socket_.get(), static_cast<short>(is_sent_ ? POLLIN : POLLOUT), 0};
  if (::poll(&now, 1, 0) <= 0) return;
  if (!is_sent_) {
    const std::string request = "GET /health HTTP/1.1\r\nHost: " + at_.text() + "\r\nConnection: close\r\n\r\n";
    is_sent_ = ::send(socket_.get(), request.data(), request.size(), MSG_NOSIGNAL) > 0;
    if (!is_sent_) socket_ = api::UniqueFd();  // nobody listens
    return;
  }
  std::array<char, 64> answer{};
  if (::recv(socket_.get(), answer.data(), answer.size(), 0) >= 0 || errno == ECONNRESET) heard();
}

void HealthCheck::heard() {
  socket_ = api::UniqueFd();
  silent_s_ = 0.0;
}

}  // namespace liana::launcher
