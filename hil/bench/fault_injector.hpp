// Begins and ends the faults of the list, slot by slot.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hil/bench/drive_bank.hpp"
#include "hil/config/fault_config.hpp"
#include "hil/math/reduced.hpp"

namespace liana::bench {

constexpr double kMoving_rad_s =
    0.1 * 3.14159265358979323846 / 180.0;  // a twentieth of the arm's speed limit, far over its tremble at rest

class FaultInjector {
 public:
  // When a fault of the list really began and ended; empty: it did not.
  struct Course {
    std::optional<std::uint32_t> begun;
    std::optional<std::uint32_t> ended;
  };

  explicit FaultInjector(std::vector<FaultConfig> faults);

  // At the start of every slot, in ascending order: true angles and rates as they are now.
  void step(std::uint32_t slot, const Theta& theta_rad, const Theta& rate_rad_s, DriveBank& drives);

  const std::vector<FaultConfig>& faults() const { return faults_; }
  // One per fault of the list.
  const std::vector<Course>& courses() const { return courses_; }

 private:
  bool is_due(std::size_t fault, std::uint32_t slot, const Theta& theta_rad, const Theta& rate_rad_s,
              const DriveBank& drives);

  std::vector<FaultConfig> faults_;
  std::vector<Course> courses_;
  std::vector<std::uint32_t> held_;  // slots in a row in which the condition of a fault held
};

}  // namespace liana::bench
