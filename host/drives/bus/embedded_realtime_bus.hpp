// The embedded bus in real time: nobody waits for anybody.
#pragma once

#include <memory>

#include "host/drives/bus/embedded_link.hpp"
#include "host/drives/bus/realtime_bus.hpp"

namespace liana::bus {

class EmbeddedRealtimeBus final : public RealtimeBus {
 public:
  explicit EmbeddedRealtimeBus(std::unique_ptr<EmbeddedLink> link);
  int bus_count() const noexcept override { return link_->welcome().bus_count; }
  SendResult send(int bus, const CanFrame& frame) noexcept override;

 private:
  void drain() noexcept override;
  void flush() noexcept override;
  bool ended() const noexcept override { return ended_; }
  void end() noexcept;

  std::unique_ptr<EmbeddedLink> link_;
  wire::Yield yield_;
  wire::Wake wake_;
  bool ended_ = false;
};

}  // namespace liana::bus
