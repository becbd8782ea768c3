// Scripted loss on the embedded bus (docs/bus-protocol.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace liana {

// Frames of a bus that get lost.
struct DropRule {
  int bus = 0;
  std::optional<std::uint32_t> id;  // nothing = every frame
  std::uint64_t from_slot = 0;
  std::uint64_t to_slot = 0;  // inclusive
};

class FaultScript {
 public:
  FaultScript() = default;
  explicit FaultScript(std::vector<DropRule> rules) : rules_(std::move(rules)) {}
  // Whether a frame that ends in `slot` is lost.
  bool drops(int bus, std::uint32_t id, std::uint64_t slot) const {
    for (const DropRule& rule : rules_) {
      if (rule.bus == bus && slot >= rule.from_slot && slot <= rule.to_slot && (!rule.id || *rule.id == id)) return true;
    }
    return false;
  }

 private:
  std::vector<DropRule> rules_;
};

// Reads a script; throws std::runtime_error naming file, entry, field and what is allowed. Buses are 0..bus_count-1.
FaultScript load_fault_script(const std::string& path, int bus_count);

}  // namespace liana
