// The 3-D simulation end for a serial arm: where its links go when its drives are told a sequence of angles.
#pragma once

#include "host/model/simulation/distances.hpp"
#include "host/model/simulation/serial_contact.hpp"

namespace liana::simulation {

// The way that a serial arm goes, a pose at every row of the sequence.
struct SerialMotion {
  std::vector<serial::JointVector> joint_rad;
  std::vector<Vec3> tip_in_base_m;
  Distances distances;
};

class SerialSimulation {
 public:
  // Distances to the scene beyond `enough_m` are not told apart. What the arm may carry is the scene's payload.
  SerialSimulation(const SerialModel& model, const config::SceneConfig& scene,
                   double enough_m = clearance::kNoObstacle_m);

  // The arm begins at the measured angles `start_rad`; joints follow what their drives are told to the first order, and
  // stay as far beside it as they are at the start. Joints and gears are rigid, the base stands still, with the
  // first piece of link 1, which no body of the scene is too near to. `carries`: what it may carry is on its tip.
  // The result is valid until the next run. About 3,000 instructions a row, and the distances.
  const SerialMotion& run(const serial::JointVector& start_rad, const ToldRows<serial::JointVector>& told,
                          bool carries = false);

  const config::SceneConfig& scene() const { return scene_; }
  const SerialContact& contact() const { return contact_; }

 private:
  void follow(const serial::JointVector& start_rad, const ToldRows<serial::JointVector>& told);
  void add_to_way(const SerialAxis& axis, bool carries, double turned_rad);
  void measure_to_bodies(bool carries, double interval_s);

  SerialModel model_;
  config::SceneConfig scene_;
  double enough_m_;
  std::optional<CarriedBody> carried_;
  SerialContact contact_;
  double length_m_;
  std::vector<SerialAxis> axes_;
  Way moving_;  // all points but the first, then the two of what is carried
  SerialMotion motion_;
};

}  // namespace liana::simulation
