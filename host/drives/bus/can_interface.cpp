#include "host/drives/bus/can_interface.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace liana::bus {
namespace {

constexpr int kArpHardwareCan = 280;  // ARPHRD_CAN
constexpr int kMinTransmitQueue = 64;

std::string interface_list() {
  std::string list;
  for (const std::string& name : can_interfaces()) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "this machine has no CAN interface" : "this machine has " + list;
}

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw std::runtime_error("CAN interface " + name + ": " + reason);
}

int raw_socket(const std::string& name) {
  const int descriptor = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor >= 0) return descriptor;
  refuse(name, std::string("this kernel has no CAN (") + std::strerror(errno) +
                   "); load it (modprobe can_raw), use a kernel that has it, or use the embedded bus (--bus embedded)");
}

ifreq request_for(const std::string& name) {
  ifreq request{};
  std::strncpy(request.ifr_name, name.c_str(), IFNAMSIZ - 1);
  return request;
}

void check_interface(int descriptor, const std::string& name) {
  ifreq request = request_for(name);
  if (ioctl(descriptor, SIOCGIFHWADDR, &request) != 0) {
    refuse(name, "does not exist; " + interface_list() +
                     "; correct the bus table, or for a virtual one: ip link add dev " + name + " type vcan");
  }
  if (request.ifr_hwaddr.sa_family != kArpHardwareCan) refuse(name, "is not a CAN interface; " + interface_list());
  request = request_for(name);
  if (ioctl(descriptor, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) {
    refuse(name, "is down; set its bit rate if it is a real one (ip link set " + name +
                     " type can bitrate 1000000), then: ip link set " + name + " up");
  }
  request = request_for(name);
  // 0 means no queue at all (vcan): nothing can overflow. Linux's default of 10 is less than the frames of one tick.
  if (ioctl(descriptor, SIOCGIFTXQLEN, &request) == 0 && request.ifr_qlen > 0 && request.ifr_qlen < kMinTransmitQueue) {
    refuse(name, "its transmit queue holds " + std::to_string(request.ifr_qlen) +
                     " frames, needed are 64; ip link set " + name + " txqueuelen 128");
  }
}

void set_option(int descriptor, const std::string& name, int option, const void* value, socklen_t size) {
  if (setsockopt(descriptor, SOL_CAN_RAW, option, value, size) != 0)
    refuse(name, std::string("socket option refused: ") + std::strerror(errno));
}

void configure_and_bind(int descriptor, const std::string& name) {
  const can_err_mask_t errors =
      CAN_ERR_CRTL | CAN_ERR_BUSOFF | CAN_ERR_BUSERROR | CAN_ERR_PROT | CAN_ERR_ACK | CAN_ERR_RESTARTED;
  set_option(descriptor, name, CAN_RAW_ERR_FILTER, &errors, sizeof errors);
  // Loopback stays on: it is how other programs of this machine (vcan, candump) see our frames. We ourselves do not.
  const int off = 0;
  set_option(descriptor, name, CAN_RAW_RECV_OWN_MSGS, &off, sizeof off);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(name.c_str()));
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    refuse(name, std::string("cannot be bound: ") + std::strerror(errno));
}

}  // namespace

std::vector<std::string> can_interfaces() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/sys/class/net", error)) {
    int type = 0;
    std::ifstream(entry.path() / "type") >> type;
    if (type == kArpHardwareCan) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

int open_can_interface(const std::string& name) {
  const int descriptor = raw_socket(name);
  try {
    check_interface(descriptor, name);
    configure_and_bind(descriptor, name);
  } catch (...) {
    close(descriptor);
    throw;
  }
  return descriptor;
}

}  // namespace liana::bus
