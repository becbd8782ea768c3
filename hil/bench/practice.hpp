// Faults that a person has happen while the bench runs, over a local socket (docs/how-to/run-hil.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench/fault_injector.hpp"
#include "hil/bench/plant.hpp"
#include "hil/bus/socket.hpp"

namespace liana::bench {

class Practice {
 public:
  static constexpr std::size_t kMaxClients = 40;  // a gateway has 32
  static constexpr std::size_t kMaxFaults = 200;  // that the bench keeps in one life

  // Listens at `path` (SOCK_SEQPACKET) until it ends, which removes the path; empty: nobody is heard. Throws
  // std::runtime_error when it cannot.
  explicit Practice(const std::string& path);
  ~Practice();
  Practice(const Practice&) = delete;

  // At the start of a slot: does what clients have sent since the last call, and answers each. A packet is a list of
  // faults that begin now, or the JSON text "end".
  void serve(std::uint32_t slot, const Plant& plant, FaultInjector& injector);

 private:
  void serve_client(Socket& client, std::uint32_t slot, const Plant& plant, FaultInjector& injector);

  std::string path_;
  Socket listener_;
  std::vector<Socket> clients_;
};

// What a packet does, and its answer: {"op":"ok","on":[{"kind":...,"drives":[...],"can_end":...}]} with the faults that
// are on, or {"op":"error","code":"refused","message":...}.
std::string practise(const std::string& packet, std::uint32_t slot, const Plant& plant, FaultInjector& injector);

}  // namespace liana::bench
