#include "host/operator/station/steering.hpp"

#include <cmath>

namespace liana::station {
namespace {

constexpr double kJitter = 0.05;  // share of a delay
constexpr std::uint64_t kForwardPurpose = 61;
constexpr std::uint64_t kBackPurpose = 62;

haptics::LinkTable link(double delay_s) { return {delay_s, kJitter, 0.0}; }

}  // namespace

std::vector<simulated::OperatorAnswer> RecordedSteering::on_news(const News& news) {
  for (const Json& picture : news.pictures) {
    if (const auto seen = sighting_in(picture)) session_.on_camera(picture);
  }
  return {session_.on_state(news.state)};
}

HumanSteering::HumanSteering(HumanSession session, const haptics::Delays& delays, std::uint64_t seed)
    : session_(std::move(session)),
      to_arm_(link(delays.forward_s), seed, kForwardPurpose),
      from_arm_(link(delays.back_s), seed, kBackPurpose) {}

// Of a state that a later one has overtaken nothing counts; of samples neither, but what was said is heard.
std::vector<simulated::OperatorAnswer> HumanSteering::on_news(const News& news) {
  const double now_s = news.state.at("time_s").get<double>();
  const std::int64_t now_us = std::llround(1e6 * now_s);
  from_arm_.send(news, now_us);
  while (const auto come = from_arm_.receive(now_us)) {
    if (come->is_newest) session_.hear(*come->load, now_s);
  }
  to_arm_.send(session_.act(now_s), now_us);
  std::vector<simulated::OperatorAnswer> come;
  while (const auto answer = to_arm_.receive(now_us)) {
    come.push_back(*answer->load);
    if (answer->is_newest) continue;
    come.back().samples.clear();
    come.back().aside.clear();
  }
  return come;
}

}  // namespace liana::station
