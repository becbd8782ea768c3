// One program on the embedded bus, as the bus process sees it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/base/net/socket.hpp"
#include "host/drives/bus/bus_protocol.hpp"

namespace liana::bus_simulator {

class Participant {
 public:
  Participant(api::UniqueFd socket, const wire::Hello& hello);

  const std::string& name() const { return name_; }
  wire::Role role() const { return role_; }
  int descriptor() const { return socket_.get(); }

  // Keeps a frame for the next WAKE.
  void keep(const wire::Frame& frame) { inbox_.push_back(frame); }
  std::size_t frames() const { return inbox_.size(); }
  // A SYNC has ended that this participant received, at `now_ns`.
  void note_sync(std::uint64_t now_ns) {
    if (!sync_seen_) sync_ns_ = now_ns;
    sync_seen_ = true;
  }
  bool sync_seen() const { return sync_seen_; }
  // The first one since the last WAKE.
  std::uint64_t sync_ns() const { return sync_ns_; }
  // Sends WAKE with the kept frames (at most 256); false when the participant has gone. Without `block`, a full socket
  // keeps them.
  bool wake(std::uint8_t flags, std::uint32_t slot, std::uint64_t now_us, bool block);

  enum class Received { kYield, kNothing, kGone, kMalformed };
  // Reads one YIELD, if there is one; yield() then holds it. `block`: waits for it, or for a signal.
  Received receive(bool block);
  const wire::Yield& yield() const { return *yield_; }
  // Sends ERROR.
  void refuse(const std::string& reason);

  bool awake = false;          // woken, has not yielded
  std::uint64_t until_ns = 0;  // when it wants to run
  bool wake_on_sync = false;

 private:
  api::UniqueFd socket_;
  std::string name_;
  wire::Role role_;
  std::vector<wire::Frame> inbox_;
  bool sync_seen_ = false;
  std::uint64_t sync_ns_ = 0;
  std::unique_ptr<wire::Wake> wake_ = std::make_unique<wire::Wake>();
  std::unique_ptr<wire::Yield> yield_ = std::make_unique<wire::Yield>();
};

}  // namespace liana::bus_simulator
