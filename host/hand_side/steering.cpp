#include "host/hand_side/steering.hpp"

#include <cstdio>
#include <utility>

#include "host/json/json.hpp"

namespace liana::hand_side {
namespace {

constexpr double kJitter = 0.05;  // share of a delay
constexpr std::uint64_t kForwardPurpose = 61;
constexpr std::uint64_t kBackPurpose = 62;

haptic::LinkTable link(double delay_s) { return {delay_s, kJitter, 0.0}; }

}  // namespace

HumanSteering::HumanSteering(HumanSession session, const haptic::Delays& delays, std::uint64_t seed)
    : session_(std::move(session)),
      to_arm_(link(delays.forward_s), seed, kForwardPurpose),
      from_arm_(link(delays.back_s), seed, kBackPurpose) {}

// A picture that cannot be one is not looked at.
void HumanSteering::take(const Json& message, double now_s) {
  if (message.value("op", "") == "state") return session_.hear(message, now_s);
  try {
    session_.see(message, now_s);
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "liana-operator: %s\n", error.what());
  }
}

std::vector<Json> HumanSteering::on_state(const Json& state) {
  const double now_s = state.at("time_s").get<double>();
  news_.push_back(state);
  from_arm_.send(std::exchange(news_, {}), now_s);
  for (const Json& message : from_arm_.receive(now_s)) take(message, now_s);
  to_arm_.send(session_.act(now_s), now_s);
  return to_arm_.receive(now_s);
}

}  // namespace liana::hand_side
