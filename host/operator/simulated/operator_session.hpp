// What the person hears of lianad, and does: samples of the devices, and what is said aloud.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/api/device/capability.hpp"
#include "host/base/json/json.hpp"
#include "host/operator/simulated/haptic_operator_model.hpp"
#include "host/operator/simulated/recorded_vr.hpp"

namespace liana::simulated {

// The step the mission has announced, as far as the person is concerned.
struct AnnouncedStep {
  std::int64_t index = -1;
  std::string name;
  std::string device;      // vr, hand or none
  std::string task;        // vr: name of the recording; hand: "slit" or "rod"; empty: told by the step's name
  std::int64_t entry = 0;  // grows from step to step, also when a step comes again
};

// The one of the two devices that is not of this kind.
device::Kind other_of(device::Kind kind);

// What the person does in one interval.
struct OperatorAnswer {
  device::Kind kind = device::Kind::kNone;  // of the device that is moved
  std::vector<device::Sample> samples{};    // of it, oldest first
  std::vector<device::Sample> aside{};      // of the other one, held as well
  std::vector<Json> messages{};             // to lianad's API
};

// Turns state and camera messages into device samples. Reads of the state only the step, the device, its mapping,
// whether it is engaged, and the time.
class OperatorSession {
 public:
  // `recordings` are the folders of the `.hand` files, searched in turn.
  OperatorSession(std::vector<std::string> recordings, const SlitModel& drawing, const HandGains& gains,
                  std::uint64_t seed, Temper temper = Temper::kGentle);

  // What to send in answer to one state. Throws std::runtime_error when a recording cannot be read.
  OperatorAnswer on_state(const Json& state);
  // One forwarded camera message. Throws std::runtime_error when it is malformed.
  void on_camera(const Json& message);

 private:
  void begin_step(const AnnouncedStep& step, const Json& state);
  OperatorAnswer steer_vr(double from_s, double to_s, bool engaged);
  OperatorAnswer steer_hand(double from_s, double to_s, bool engaged);
  void hold_handles_too(std::vector<device::Sample>& aside, double from_s, double to_s);
  void report_arrival(std::vector<Json>& messages, bool arrived, double now_s);

  std::string recording_called(const std::string& name) const;

  std::vector<std::string> recordings_;
  HapticOperatorModel person_;
  std::uint64_t seed_;
  Temper temper_;
  std::optional<RecordedVr> vr_;
  AnnouncedStep step_{};
  bool steering_ = false;  // the announced device is ours to move
  bool reported_ = false;
  double now_s_ = -1.0;       // time of the last state
  double finished_s_ = -1.0;  // when the recording ended, or -1
};

// The step in a state message; index -1 when there is none.
AnnouncedStep announced_step(const Json& state);
// What the hand is asked for in a step: its task, or what its name tells.
HandTask hand_task(const AnnouncedStep& step);
// Mapping of the device in use; 1:1 where the state does not say.
HandMapping announced_mapping(const Json& state);

}  // namespace liana::simulated
