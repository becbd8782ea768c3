#include "hil/payload/adapter_node.hpp"

#include <algorithm>
#include <cmath>

namespace liana::bench {

namespace {

constexpr std::uint8_t kLock = 1, kRelease = 2;
constexpr double kDepthStep_m = 1e-4;

std::uint8_t in_steps(double depth_m) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(depth_m / kDepthStep_m), 0L, 255L));
}

}  // namespace

// A command counts once for every new sequence number; before the first, that is 0.
void AdapterNode::obey(const CanFrame& frame, Adapter& adapter) {
  if (frame.length < 2 || frame.data[1] == last_command_) return;
  last_command_ = frame.data[1];
  if (frame.data[0] == kLock) adapter.begin_lock();
  if (frame.data[0] == kRelease) adapter.release();
}

void AdapterNode::report(const Adapter& adapter, FrameList& out) {
  if (defects_.lost) return;
  if (!defects_.stale || !last_report_) {
    const bool captured = (adapter.captured() || defects_.early) && !defects_.denied;
    const PinValues& depth_m = adapter.depth_m();
    FrameList made;
    const std::array<std::uint8_t, 8> bytes{++sequence_,
                                            static_cast<std::uint8_t>(captured ? 1 : 0),
                                            static_cast<std::uint8_t>(adapter.latch()),
                                            static_cast<std::uint8_t>(adapter.lock()),
                                            in_steps(depth_m[0]),
                                            in_steps(depth_m[1]),
                                            in_steps(depth_m[2]),
                                            0};
    node_.send(0x180 + kNode, bytes, made);
    last_report_ = made.front();
  }
  for (int times = defects_.twice ? 2 : 1; times > 0; --times) out.push_back(*last_report_);
}

void AdapterNode::exchange(const FrameList& frames, std::uint64_t now_us, Adapter& adapter, FrameList& out) {
  for (const CanFrame& frame : frames) {
    if (!node_.hears(frame) || !node_.is_operational()) continue;
    if (frame.id == 0x200 + kNode) obey(frame, adapter);
    if (frame.id == 0x080 && node_.syncs() % kEverySync == 0) report(adapter, out);
  }
  node_.tick(now_us, out);
}

}  // namespace liana::bench
