// Begins and ends the faults of the list, slot by slot.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hil/bench/drives.hpp"
#include "hil/config/fault_config.hpp"

namespace liana::bench {

constexpr double kMoving_rad_s =
    0.1 * 3.14159265358979323846 / 180.0;  // a twentieth of the arm's speed limit, far over its tremble at rest

constexpr double kNoDepth_m = -1000.0;  // there is nothing to be deep in

// What conditions of faults are about.
struct TrueMotion {
  std::span<const double> angle_rad;
  std::span<const double> rate_rad_s;
  double depth_m = kNoDepth_m;  // of the tip past the mouth of the slit, of a payload's pins past the adapter's face
  double contact_N = 0.0;       // of the payload on the adapter
  bool captured = false;        // the adapter has the payload
  double carried = 0.0;         // share of its way that the arm that carries is told to have gone
};

class FaultInjector {
 public:
  // When a fault of the list really began and ended; empty: it did not.
  struct Course {
    std::optional<std::uint32_t> begun;
    std::optional<std::uint32_t> ended;
  };

  explicit FaultInjector(std::vector<FaultConfig> faults);

  // Adds faults to the list while the bench runs.
  void add(const std::vector<FaultConfig>& more);
  // Ends with the next step all that is on and can end.
  void end_all();
  // At the start of every slot, in ascending order: the arm as it truly is now.
  void step(std::uint32_t slot, const TrueMotion& arm, Drives& drives);

  const std::vector<FaultConfig>& faults() const { return faults_; }
  // The fault has begun and not ended.
  bool is_on(std::size_t fault) const { return courses_[fault].begun && !courses_[fault].ended; }
  // One of this kind is on at the drive.
  bool has(FaultKind kind, std::size_t drive) const;
  // One per fault of the list.
  const std::vector<Course>& courses() const { return courses_; }

 private:
  bool is_due(std::size_t fault, std::uint32_t slot, const TrueMotion& arm, const Drives& drives);
  bool holds(const FaultCondition& when, std::uint32_t slot, const TrueMotion& arm, const Drives& drives) const;

  std::vector<FaultConfig> faults_;
  std::vector<Course> courses_;
  std::vector<std::uint32_t> held_;  // slots in a row in which the condition of a fault held
};

}  // namespace liana::bench
