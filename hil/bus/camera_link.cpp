#include "hil/bus/camera_link.hpp"

#include <sys/socket.h>

#include <array>

namespace liana::bench {

void CameraLink::connect(int patience_ms) {
  if (path_.empty() || socket_.open()) return;
  socket_ = connect_local(path_, patience_ms);
  if (socket_.open()) push(R"({"op":"hello","name":"bench","role":"camera","lockstep":false,"subscribe":[]})");
}

bool CameraLink::push(const std::string& message) {
  const ssize_t size = ::send(socket_.descriptor(), message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  return size == static_cast<ssize_t>(message.size());
}

void CameraLink::discard_answers() {
  std::array<char, 65536> answer;
  while (::recv(socket_.descriptor(), answer.data(), answer.size(), MSG_DONTWAIT) > 0) {
  }
}

void CameraLink::send(const std::string& message) {
  if (path_.empty()) return;
  connect(0);
  if (!socket_.open() || !push(message)) {
    ++lost_;
    return;
  }
  ++sent_;
  discard_answers();
}

}  // namespace liana::bench
