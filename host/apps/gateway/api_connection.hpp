// A connection to lianad that never waits: packets out as far as there is room, packets in as they come.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <string>

#include "host/apps/gateway/poller.hpp"
#include "host/base/net/socket.hpp"

namespace liana::gateway {

class ApiConnection {
 public:
  static constexpr std::size_t kMaxWaiting = 64;            // packets that lianad has not taken yet
  static constexpr std::size_t kMaxWaitingBytes = 1 << 20;  // of them

  using Take = std::function<void(const std::string& packet)>;
  using Closed = std::function<void()>;

  // `poller` must outlive this. `take` gets every packet; `closed` is told once when lianad has left. Neither may
  // destroy this object; both may close() it.
  ApiConnection(Poller& poller, std::string path, Take take, Closed closed);
  ~ApiConnection() { close(); }
  ApiConnection(const ApiConnection&) = delete;
  ApiConnection& operator=(const ApiConnection&) = delete;

  // Tries to connect; false when nobody listens there or its queue of connections is full (errno).
  bool connect();
  bool is_open() const { return fd_.get() >= 0; }
  // Hands a packet over, or keeps it until lianad reads; false when closed or too much waits already.
  bool send(std::string packet);
  // Ends the connection; `closed` is not told.
  void close();

 private:
  void ready(std::uint32_t events);
  void read();
  void flush();
  void watch(bool for_room);
  void lost();

  Poller& poller_;
  std::string path_;
  Take take_;
  Closed closed_;
  api::UniqueFd fd_;
  std::deque<std::string> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool waits_for_room_ = false;
};

}  // namespace liana::gateway
