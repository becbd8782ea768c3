#include "host/hand_side/delay_line.hpp"

#include <cmath>

#include "host/json/json.hpp"

namespace liana::hand_side {
namespace {

std::int64_t microseconds(double time_s) { return std::llround(time_s * 1e6); }

}  // namespace

void DelayLine::send(std::vector<Json> messages, double now_s) {
  if (messages.empty()) return;
  link_.send({sequence_++, std::make_shared<const std::vector<Json>>(std::move(messages))}, microseconds(now_s));
}

std::vector<Json> DelayLine::receive(double now_s) {
  std::vector<Json> come;
  while (const auto parcel = link_.receive(microseconds(now_s))) {
    const bool newest = newest_.accept(parcel->sequence);
    for (const Json& message : *parcel->messages) {
      if (newest || message.value("op", "") == "operator_says") come.push_back(message);
    }
  }
  return come;
}

}  // namespace liana::hand_side
