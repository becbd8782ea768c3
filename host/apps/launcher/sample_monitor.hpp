// What lianad's states tell of the samples of operators' devices over a run: how far apart they were, and how old when
// a command made of them was released, and when it came into force (docs/explanation/operator-model.md). The clock of
// liana-operator's devices is the arm's.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::launcher {

class SampleMonitor {
 public:
  // A state (docs/reference/api.md), in the order in which they come.
  void look(const Json& state);

  // Samples in the slowest second of any device's use [Hz]; nothing when none was used for a second.
  std::optional<double> slowest_hz() const { return slowest_hz_; }
  // By what use_device named: `interval_s` (`least`, `most`), `to_release_s` and `in_force_s` (`median`, `worst`; null
  // where it never steered). Null when no device gave a sample.
  Json json() const;

 private:
  struct OfDevice {
    double least_s = 0.0, most_s = 0.0;
    std::vector<double> to_release_s, in_force_s;  // from the middle between newest and oldest sample of each command
    double worst_release_s = 0.0, worst_in_force_s = 0.0;  // from the oldest samples
  };

  void look_at_rate(const Json& rate, OfDevice& device);
  void look_at_command(const Json& verdict, OfDevice& device);

  std::map<std::string, OfDevice> devices_;
  std::optional<double> slowest_hz_;
  std::uint64_t command_ = 0;  // the last one that was looked at
};

}  // namespace liana::launcher
