#include "host/apps/gateway/stop_call.hpp"

#include <utility>

#include "host/apps/gateway/requester.hpp"

namespace liana::gateway {

StopCall::StopCall(Poller& poller, const std::string& api, std::string name, Answer answer)
    : link_(
          poller, api, [this](const std::string& packet) { take(packet); }, [] {}),
      name_(std::move(name)),
      answer_(std::move(answer)) {}

void StopCall::press(double now_s, std::optional<std::int64_t> id, const std::string& reason) {
  const bool is_first = ids_.empty();
  if (ids_.size() < kMaxIds) ids_.push_back(id);
  if (!is_first) return;
  since_s_ = now_s;
  reason_ = reason;
  call();
}

void StopCall::tick(double now_s) {
  if (ids_.empty()) return;
  if (now_s - since_s_ > kPatience_s)
    return end({{"op", "error"}, {"code", "away"}, {"message", "lianad did not confirm the stop; cut the power"}});
  if (!link_.is_open()) call();
}

// Where lianad has no place left it refuses the hello, but not the stop.
void StopCall::call() {
  if (!link_.connect()) return;
  link_.send(Json{{"op", "hello"}, {"name", name_}, {"role", "observer"}, {"lockstep", false}}.dump());
  Json stop{{"op", "stop"}, {"id", 1}};
  if (!reason_.empty()) stop["reason"] = reason_;
  link_.send(stop.dump(-1, Json::BadUtf8::kReplace));
}

void StopCall::take(const std::string& packet) {
  const Json message = Json::parse_or_null(packet);
  if (message.member_or_null("id") == 1) end(message);
}

void StopCall::end(Json lianad_says) {
  link_.close();
  for (const auto& id : std::exchange(ids_, {})) answer_(answer_from(lianad_says, id));
}

}  // namespace liana::gateway
