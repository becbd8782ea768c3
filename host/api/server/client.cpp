#include "host/api/server/client.hpp"

#include <stdexcept>

#include "host/base/json/json.hpp"
#include "host/base/net/connect.hpp"

namespace liana::api {

namespace {
constexpr double kSendTimeout_s = 10.0;

[[noreturn]] void throw_gone() {
  throw std::runtime_error("lianad is gone: it closed the API socket: liana log list says how it ended");
}
}  // namespace

ApiClient ApiClient::connect(const std::string& path, double timeout_s) {
  return ApiClient(connect_to("--api", path, timeout_s));
}

void ApiClient::send(const Json& request) {
  const std::string packet = request.dump();
  if (packet.size() > kMaxPacketBytes) {
    throw std::runtime_error("API request of " + std::to_string(packet.size()) + " bytes: at most " +
                             std::to_string(kMaxPacketBytes) + "; give fewer points, or numbers with fewer digits");
  }
  SocketResult result = send_packet(fd_.get(), packet);
  if (result == SocketResult::kWouldBlock && wait_writable(fd_.get(), kSendTimeout_s))
    result = send_packet(fd_.get(), packet);
  if (result == SocketResult::kClosed) throw_gone();
  if (result == SocketResult::kWouldBlock)
    throw std::runtime_error("lianad does not read its API socket: see docs/how-to/nothing-answers.md");
}

bool ApiClient::receive_bytes(std::string& packet, double timeout_s) {
  if (timeout_s > 0.0 && timeout_s != limit_s_) limit_wait(fd_.get(), limit_s_ = timeout_s);
  const SocketResult result = timeout_s > 0.0 ? await_packet(fd_.get(), packet) : receive_packet(fd_.get(), packet);
  if (result == SocketResult::kClosed) throw_gone();
  return result == SocketResult::kDone;
}

std::optional<Json> ApiClient::receive(double timeout_s) {
  std::string packet;
  if (!receive_bytes(packet, timeout_s)) return std::nullopt;
  return Json::parse(packet);
}

}  // namespace liana::api
