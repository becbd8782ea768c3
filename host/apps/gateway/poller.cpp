#include "host/apps/gateway/poller.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace liana::gateway {

Poller::Poller() : epoll_(epoll_create1(EPOLL_CLOEXEC)) {
  if (epoll_.get() < 0) throw std::runtime_error(std::string("no epoll: ") + std::strerror(errno));
}

void Poller::watch(int fd, std::uint32_t events, Ready ready) {
  epoll_event event{};
  event.events = events;
  event.data.fd = fd;
  const int how = watched_.contains(fd) ? EPOLL_CTL_MOD : EPOLL_CTL_ADD;
  if (epoll_ctl(epoll_.get(), how, fd, &event) != 0)
    throw std::runtime_error(std::string("epoll: ") + std::strerror(errno));
  watched_[fd] = std::make_shared<const Ready>(std::move(ready));
}

void Poller::forget(int fd) {
  if (watched_.erase(fd) > 0) epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, fd, nullptr);
}

void Poller::run_ready() {
  std::array<epoll_event, 64> events{};
  const int count = epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()), 0);
  for (int i = 0; i < count; ++i) {
    const auto found = watched_.find(events[static_cast<std::size_t>(i)].data.fd);
    if (found == watched_.end()) continue;
    const std::shared_ptr<const Ready> ready = found->second;  // outlives a forget() in it
    (*ready)(events[static_cast<std::size_t>(i)].events);
  }
}

}  // namespace liana::gateway
