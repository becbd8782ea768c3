// A serial arm and its drives as the bench's plant: rigid joints that go where their position servos take them, and the
// torque which that needs.
#pragma once

#include <vector>

#include "hil/bench/plant.hpp"
#include "hil/serial/joint_chain.hpp"
#include "hil/serial/joint_drives.hpp"

namespace liana::bench {

// Throw std::runtime_error for options and faults that mean nothing to any serial arm.
void refuse_for_serial(const ModelOptions& options);
void refuse_for_serial(const std::vector<FaultConfig>& faults);

class SerialPlant final : public Plant {
 public:
  // Throws std::runtime_error for anything that cannot work, faults of cables among it.
  SerialPlant(const SerialRobotConfig& robot, const SceneConfig& scene, const BusesConfig& buses,
              const ModelOptions& options, const std::vector<FaultConfig>& faults, std::uint64_t seed);

  const Drives& drives() const override { return drives_; }
  void refuse(const std::vector<FaultConfig>& faults) const override;
  void inject(std::uint32_t slot, FaultInjector& injector) override;
  void exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) override;
  void integrate(double period_s) override;
  void remove_rod() override {}
  Pose tip() const override { return chain_.tip(); }
  double fastest_rad_s() const override;
  std::vector<std::string> truth_columns() const override;
  void add_truth(std::vector<double>& row) override;
  void summarise(nlohmann::json& summary) const override;

 private:
  double friction_Nm(double rate_rad_s) const;

  SceneConfig scene_;
  TrueArm arm_;
  JointChain chain_;
  JointDrives drives_;
  std::vector<double> torque_Nm_;
};

}  // namespace liana::bench
