// Who answers lianad at the input devices: recorded hands and a simulated person at the hand controller, or a simulated
// person at everything, perhaps behind a delayed link.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/hand_side/delay_line.hpp"
#include "host/hand_side/human_session.hpp"
#include "host/json/json_fwd.hpp"
#include "host/operator/operator_session.hpp"

namespace liana::hand_side {

class Steering {
 public:
  virtual ~Steering() = default;
  // What is sent in answer to one state, without or with a picture of the camera before it. Throws std::runtime_error
  // when a message, or a recording, cannot be used.
  virtual std::vector<Json> on_state(const Json& state) = 0;
  virtual void on_camera(const Json& picture) = 0;
  // Of a hand with force; nothing where there is none.
  virtual std::optional<HandFigures> figures() const { return std::nullopt; }
};

// The pair that `liana run` has without being asked for another.
class RecordedSteering final : public Steering {
 public:
  explicit RecordedSteering(operator_side::OperatorSession session) : session_(std::move(session)) {}
  std::vector<Json> on_state(const Json& state) override { return session_.on_state(state); }
  void on_camera(const Json& picture) override { session_.on_camera(picture); }

 private:
  operator_side::OperatorSession session_;
};

class HumanSteering final : public Steering {
 public:
  HumanSteering(HumanSession session, const haptic::Delays& delays, std::uint64_t seed);
  std::vector<Json> on_state(const Json& state) override;
  void on_camera(const Json& picture) override { news_.push_back(picture); }
  std::optional<HandFigures> figures() const override { return session_.figures(); }

 private:
  void take(const Json& message, double now_s);

  HumanSession session_;
  DelayLine to_arm_;
  DelayLine from_arm_;
  std::vector<Json> news_;  // since the last state
};

}  // namespace liana::hand_side
