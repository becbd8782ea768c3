// A simulated person who steers every step: VR handles by the display, the hand controller by the tip camera and with
// the force of a simulated Omega.6. What comes from the arm may be late; nothing else of the arm is known here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/api/device/liana_device.h"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/operator/haptics/held_hand.hpp"
#include "host/operator/haptics/prediction_track.hpp"
#include "host/operator/simulated/arm_display.hpp"
#include "host/operator/simulated/operator_session.hpp"
#include "host/operator/simulated/vr_operator_model.hpp"
#include "host/operator/station/tip_prediction.hpp"

namespace liana::station {

struct HumanTable {
  std::string feedback{};         // a law's name, or off; empty: as every step of the mission says
  bool passivity = true;          // energy tank and damping at the device
  bool walls = true;              // those that the device is told are felt
  double there_and_back_s = 0.0;  // delay of the link, known to the person
  std::uint64_t seed = 1;
  simulated::Temper temper = simulated::Temper::kGentle;
};

// What only the hand's side knows of a run.
struct HandMotionParams {
  double peak_force_N = 0.0;       // of the device's motors
  double min_energy_J = 0.0;       // at its port; negative: given to the hand
  std::vector<double> errors_m{};  // prediction of the tip against what was measured then, while steered by hand
};

// What comes from the arm in one command interval.
struct News {
  Json state;                               // of lianad's API
  std::vector<Json> pictures;               // of the tip camera, since the interval before
  std::optional<liana_state> for_device{};  // what the hand controller was told
};

// What a picture shows; nothing, and a line on standard error, for one that cannot be a picture.
std::optional<simulated::TipObservation> sighting_in(const Json& picture);

// Deterministic: the same calls give the same messages. Times are by the hand's clock [s] and rise.
class HumanSession {
 public:
  HumanSession(const HumanTable& table, const config::RobotConfig& robot, const config::SceneConfig& scene);

  // News has come. Throws std::runtime_error when the state is not one of this robot.
  void hear(const News& news, double now_s);
  // A command interval is over: what the devices sensed in it, and what the person says.
  simulated::OperatorAnswer act(double now_s);

  HandMotionParams figures() const;

 private:
  void begin_step(const Json& state, double now_s);
  void choose_law(const Json& state);
  void hear_of_hand(const News& news, bool engaged, double now_s);
  void feel(const liana_state& told);
  void feel_walls(const liana_state* told);
  std::vector<device::Sample> lead(double now_s);
  std::vector<device::Sample> steer(double from_s, double now_s);
  void hold_other_too(std::vector<device::Sample>& aside, double from_s, double now_s);
  bool has_arrived() const;
  void predict(double now_s);

  HumanTable table_;
  std::size_t node_;
  simulated::ArmDisplay display_;
  simulated::VrOperatorModel vr_person_;
  simulated::HapticOperatorModel hand_person_;
  haptics::HeldHand held_;
  TipPrediction prediction_;
  haptics::PredictionTrack unmended_;   // by the filter alone
  haptics::PredictionTrack predicted_;  // the same, mended by what was heard
  simulated::AnnouncedStep step_{};
  bool feels_arm_ = true;
  bool steering_ = false;
  bool reported_ = false;
  double acted_s_ = 0.0;
  double handles_s_ = 0.0;  // when the handles were sampled last
  Vec3 slowed_m_{};         // commanded less predicted, as last heard: the arm's limits slow it down
  Vec3 beside_m_{};         // measured less commanded, at rest before the grip: no contact, so it is not felt
  std::vector<double> errors_m_;
};

}  // namespace liana::station
