#include "hil/bench/practice.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hil/config/fault_kinds.hpp"

namespace liana::bench {

namespace {

// What is on after the step of this slot.
std::string ok(const FaultInjector& injector, std::uint32_t slot) {
  nlohmann::json on = nlohmann::json::array();
  for (std::size_t i = 0; i < injector.faults().size(); ++i) {
    const FaultConfig& fault = injector.faults()[i];
    const bool is_ending = fault.for_slots && *fault.for_slots == 0;
    const bool is_beginning = !injector.courses()[i].begun && fault.at_slot == slot;
    if (is_ending || !(injector.is_on(i) || is_beginning)) continue;
    nlohmann::json drives = nlohmann::json::array();
    for (const std::size_t drive : fault.drives) drives.push_back(drive + 1);
    on.push_back({{"kind", fault.name}, {"drives", drives}, {"can_end", row_of(fault.kind).can_end}});
  }
  return nlohmann::json{{"op", "ok"}, {"on", on}}.dump();
}

std::string refused(const std::string& why) {
  const nlohmann::json error{{"op", "error"}, {"code", "refused"}, {"message", why}};
  return error.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string practise(const std::string& packet, std::uint32_t slot, const Plant& plant, FaultInjector& injector) {
  try {
    if (packet == "\"end\"") {
      injector.end_all();
      return ok(injector, slot);
    }
    const std::vector<FaultConfig> faults = faults_at(slot, packet, plant.drives().size());
    if (injector.faults().size() + faults.size() > Practice::kMaxFaults)
      return refused("the bench has had " + std::to_string(injector.faults().size()) +
                     " faults; allowed are 200: start it again");
    plant.refuse(faults);
    for (const FaultConfig& fault : faults)
      for (const std::size_t drive : fault.drives)
        if (injector.has(fault.kind, drive))
          return refused("drive " + std::to_string(drive + 1) + " has a fault of kind \"" + fault.name +
                         "\" already; repair that first");
    injector.add(faults);
    return ok(injector, slot);
  } catch (const std::runtime_error& error) {
    return refused(error.what());
  }
}

Practice::Practice(const std::string& path) : path_(path), listener_(path.empty() ? Socket() : listen_local(path)) {}

Practice::~Practice() {
  if (listener_.open()) ::unlink(path_.c_str());
}

void Practice::serve(std::uint32_t slot, const Plant& plant, FaultInjector& injector) {
  if (!listener_.open()) return;
  if (clients_.size() < kMaxClients) {
    Socket client(::accept4(listener_.descriptor(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (client.open()) clients_.push_back(std::move(client));
  }
  for (Socket& client : clients_) serve_client(client, slot, plant, injector);
  clients_.erase(std::remove_if(clients_.begin(), clients_.end(), [](const Socket& client) { return !client.open(); }),
                 clients_.end());
}

// One packet of each client in a slot.
void Practice::serve_client(Socket& client, std::uint32_t slot, const Plant& plant, FaultInjector& injector) {
  std::array<char, 65536> packet;
  const ssize_t size = ::recv(client.descriptor(), packet.data(), packet.size(), 0);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (size <= 0) {
    client = Socket();
    return;
  }
  const std::string answer = practise({packet.data(), static_cast<std::size_t>(size)}, slot, plant, injector);
  if (::send(client.descriptor(), answer.data(), answer.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) client = Socket();
}

}  // namespace liana::bench
