// A cable arm and its drives as the bench's plant.
#pragma once

#include <memory>

#include "hil/arm/arm.hpp"
#include "hil/bench/drive_bank.hpp"
#include "hil/bench/load_cells.hpp"
#include "hil/bench/plant.hpp"

namespace liana::bench {

class CablePlant final : public Plant {
 public:
  // Throws std::runtime_error for anything that cannot work.
  CablePlant(const RobotConfig& robot, const SceneConfig& scene, const BusesConfig& buses, const ModelOptions& options,
             const std::vector<FaultConfig>& faults, std::uint64_t seed);

  const Drives& drives() const override { return drives_; }
  void refuse(const std::vector<FaultConfig>& faults) const override;
  void inject(std::uint32_t slot, FaultInjector& injector) override;
  void exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) override;
  void integrate(double period_s) override;
  Pose tip() const override { return arm_->tip(); }
  void remove_rod() override { arm_->remove_rod(); }
  double fastest_rad_s() const override;
  std::vector<std::string> truth_columns() const override;
  void add_truth(std::vector<double>& row) override;
  void summarise(nlohmann::json& summary) const override;

 private:
  CableValues motor_tensions_N() const;

  double depth_m() const { return depth_in_slit_m(scene_, arm_->tip().position_m); }

  std::size_t thetas_;
  std::size_t links_;
  SceneConfig scene_;
  ModelOptions options_;
  RobotConfig built_;  // the arm with its own masses and springs
  TrueParameters truth_;
  std::unique_ptr<Arm> arm_;
  DriveBank drives_;
  LoadCells load_cells_;
  Vec3 tip_before_m_;     // when truth was last asked for
  double since_s_ = 0.0;  // how long ago that was
};

}  // namespace liana::bench
