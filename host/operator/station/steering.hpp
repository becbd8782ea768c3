// Who answers lianad at the input devices: recorded hands and a simulated person at the hand controller, or a simulated
// person at everything, perhaps behind a delayed link.
#pragma once

#include <optional>
#include <vector>

#include "host/operator/simulated/operator_session.hpp"
#include "host/operator/station/delay_line.hpp"
#include "host/operator/station/human_session.hpp"

namespace liana::station {

class Steering {
 public:
  virtual ~Steering() = default;
  // What is sent in answer to the news of one command interval, oldest first. Throws std::runtime_error when a state,
  // or a recording, cannot be used.
  virtual std::vector<simulated::OperatorAnswer> on_news(const News& news) = 0;
  // Of a hand with force; nothing where there is none.
  virtual std::optional<HandMotionParams> figures() const { return std::nullopt; }
};

// The pair that `liana run` has without being asked for another.
class RecordedSteering final : public Steering {
 public:
  explicit RecordedSteering(simulated::OperatorSession session) : session_(std::move(session)) {}
  std::vector<simulated::OperatorAnswer> on_news(const News& news) override;

 private:
  simulated::OperatorSession session_;
};

class HumanSteering final : public Steering {
 public:
  HumanSteering(HumanSession session, const haptics::Delays& delays, std::uint64_t seed);
  std::vector<simulated::OperatorAnswer> on_news(const News& news) override;
  std::optional<HandMotionParams> figures() const override { return session_.figures(); }

 private:
  HumanSession session_;
  DelayLine<simulated::OperatorAnswer> to_arm_;
  DelayLine<News> from_arm_;
};

}  // namespace liana::station
