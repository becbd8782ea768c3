// A serial arm with torque drives as the bench's plant: elastic joints on the arm that carries it, the drives' torque
// loops at 1 kHz, the wrist's force sensor, and where the scene has them, payload, transfer mechanism and adapter.
// Poses that are told are in the frame of the arm's base as it is when nothing pushes.
#pragma once

#include <optional>
#include <vector>

#include "hil/bench/plant.hpp"
#include "hil/payload/adapter_node.hpp"
#include "hil/payload/payload_site.hpp"
#include "hil/payload/wrist_sensor.hpp"
#include "hil/serial/flexible_chain.hpp"
#include "hil/serial/torque_drives.hpp"

namespace liana::bench {

class TorquePlant final : public Plant {
 public:
  // Throws std::runtime_error for anything that cannot work.
  TorquePlant(const SerialRobotConfig& robot, const SceneConfig& scene, const BusesConfig& buses,
              const ModelOptions& options, const std::vector<FaultConfig>& faults, std::uint64_t seed);

  const Drives& drives() const override { return drives_; }
  void refuse(const std::vector<FaultConfig>& faults) const override;
  void inject(std::uint32_t slot, FaultInjector& injector) override;
  void exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) override;
  void integrate(double period_s) override;
  Pose tip() const override { return relative(base_at_rest_, chain_.tip().pose); }
  void remove_rod() override {}
  double fastest_rad_s() const override;
  // Whether all of its drives are enabled.
  bool has_torque() const { return drives_.enabled() == drives_.size(); }
  std::unique_ptr<TipEquipment> make_equipment(const SceneConfig& scene, std::uint64_t seed) override;
  std::vector<std::string> truth_columns() const override;
  void add_truth(std::vector<double>& row) override;
  void summarise(nlohmann::json& summary) const override;

  // Of payload and adapter; null where the scene has none.
  const PayloadSite* site() const { return site_ ? &*site_ : nullptr; }
  // Where the payload's grapple and the adapter really are.
  Pose grapple() const { return relative(base_at_rest_, site_->payload(chain_.tip().pose)); }
  Pose socket() const { return relative(base_at_rest_, site_->socket()); }
  // The end effector has closed on the payload, or opened.
  void take_payload();
  void let_go_of_payload();
  // How long the arm that carries takes from where it begins to where it locks; 0: it begins there.
  double carry_s() const { return way_ ? way_->takes_s : 0.0; }
  // It has been led through so much of that way; until 1 what it gives way by counts for no peak.
  void carry_base(double share);
  const FlexibleChain& arm() const { return chain_; }
  // True mean load of the last slot at the wrist, in the tip's frame.
  const TipLoad& wrist() const { return wrist_load_; }

 private:
  // The largest there were in the whole run.
  struct Peaks {
    double contact_N = 0.0;
    double lateral_N = 0.0;
    double joint_Nm = 0.0;
    double base_m = 0.0;
    double insertion_m = 0.0;
  };

  // Of the joints of the arm that carries.
  struct CarryTravel {
    std::vector<double> from_rad, to_rad;
    double takes_s = 0.0;
    double share = 0.0;
  };

  void make_site(const SceneConfig& scene, std::uint64_t seed);
  TipLoad meet(const TipState& tip);
  void step_physics(double step_s);
  double base_deflection_m() const;
  std::vector<double> joints_rad() const;
  void add_site_truth(std::vector<double>& row) const;
  // Of the arm and what it holds to the bodies of the scene, which go along while the arm is carried.
  double nearest_body_m() const;

  SceneConfig scene_;
  bool spread_;
  TrueArm arm_;
  FlexibleChain chain_;
  std::optional<CarryTravel> way_;  // none: it is locked for good
  Pose base_at_rest_;               // when nothing pushes
  TorqueDrives drives_;
  std::vector<RotorDrive> rotors_;
  WristSensor sensor_;
  TipLoad wrist_load_;
  std::optional<PayloadSite> site_;
  AdapterNode adapter_node_;
  Vec3 contact_N_;             // of the adapter on the payload in the last physics step, in the socket's frame
  double contact_peak_N_ = 0;  // since truth was last asked for
  Peaks peaks_;
  double elapsed_s_ = 0.0;
  std::optional<double> captured_s_;
};

}  // namespace liana::bench
