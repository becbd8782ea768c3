// The adapter's electronics, node 0x30: says what its sensors and drives do, and takes lock and release
// (docs/explanation/payload.md).
#pragma once

#include <cstdint>
#include <optional>

#include "hil/drive/self_starting_node.hpp"
#include "hil/serial/adapter.hpp"

namespace liana::bench {

// What may be wrong with what it says of the capture.
struct CaptureDefects {
  bool stale = false;   // every message is the last sound one, its sequence number too
  bool early = false;   // says captured, whatever is so
  bool twice = false;   // every message comes twice
  bool lost = false;    // no messages; its heartbeat goes on
  bool denied = false;  // never says captured
};

class AdapterNode {
 public:
  static constexpr std::uint32_t kNode = 0x30;
  static constexpr std::uint64_t kEverySync = 4;

  explicit AdapterNode(std::uint8_t bus) : node_(kNode, bus) {}

  void suffer(const CaptureDefects& defects) { defects_ = defects; }
  // Hears the slot's frames, acts on commands and sends what is due.
  void exchange(const FrameList& frames, std::uint64_t now_us, Adapter& adapter, FrameList& out);

 private:
  void obey(const CanFrame& frame, Adapter& adapter);
  void report(const Adapter& adapter, FrameList& out);

  SelfStartingNode node_;
  CaptureDefects defects_;
  std::uint8_t sequence_ = 0;
  std::uint8_t last_command_ = 0;  // its sequence number
  std::optional<CanFrame> last_report_;
};

}  // namespace liana::bench
