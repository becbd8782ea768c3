// File descriptors and what to do when they are ready; all behind one descriptor, so that another loop can wait for it.
#pragma once

#include <sys/epoll.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "host/base/net/socket.hpp"

namespace liana::gateway {

class Poller {
 public:
  using Ready = std::function<void(std::uint32_t events)>;  // EPOLLIN, EPOLLOUT, EPOLLHUP, EPOLLERR

  // Throws std::runtime_error when the system has no more descriptors.
  Poller();

  // Readable when something is ready.
  int fd() const { return epoll_.get(); }
  // Watches `fd` for `events`; what is watched already gets the new events and function. Throws std::runtime_error.
  void watch(int fd, std::uint32_t events, Ready ready);
  // Before `fd` is closed.
  void forget(int fd);
  // Calls what is ready now, at most 64, without waiting; functions may watch and forget.
  void run_ready();

 private:
  api::UniqueFd epoll_;
  std::map<int, std::shared_ptr<const Ready>> watched_;
};

}  // namespace liana::gateway
