#include "host/api/client.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "host/api/address.hpp"
#include "host/json/json.hpp"

namespace liana::api {

namespace {
constexpr double kSendTimeout_s = 10.0;
constexpr useconds_t kRetry_us = 20000;

[[noreturn]] void throw_unreachable(const std::string& path) {
  throw std::runtime_error("cannot reach lianad at " + path + ": " + std::strerror(errno) +
                           "; is it running with --api " + path + "?");
}

[[noreturn]] void throw_gone() {
  throw std::runtime_error("lianad is gone: the API socket was closed by the other end");
}
}  // namespace

ApiClient ApiClient::connect(const std::string& path, double timeout_s) {
  const sockaddr_un address = unix_address(path);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  for (;;) {
    UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
    if (fd.get() >= 0 && ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      return ApiClient(std::move(fd));
    }
    if (std::chrono::steady_clock::now() >= deadline) throw_unreachable(path);
    ::usleep(kRetry_us);
  }
}

void ApiClient::send(const Json& request) {
  const std::string packet = request.dump();
  if (packet.size() > kMaxPacketBytes) {
    throw std::runtime_error("API request of " + std::to_string(packet.size()) + " bytes: at most " +
                             std::to_string(kMaxPacketBytes));
  }
  SocketResult result = send_packet(fd_.get(), packet);
  if (result == SocketResult::kWouldBlock && wait_writable(fd_.get(), kSendTimeout_s))
    result = send_packet(fd_.get(), packet);
  if (result == SocketResult::kClosed) throw_gone();
  if (result == SocketResult::kWouldBlock) throw std::runtime_error("lianad does not read its API socket");
}

bool ApiClient::receive_bytes(std::string& packet, double timeout_s) {
  SocketResult result = receive_packet(fd_.get(), packet);
  if (result == SocketResult::kWouldBlock && timeout_s > 0.0 && wait_readable(fd_.get(), timeout_s)) {
    result = receive_packet(fd_.get(), packet);
  }
  if (result == SocketResult::kClosed) throw_gone();
  return result == SocketResult::kDone;
}

std::optional<Json> ApiClient::receive(double timeout_s) {
  std::string packet;
  if (!receive_bytes(packet, timeout_s)) return std::nullopt;
  return Json::parse(packet);
}

}  // namespace liana::api
