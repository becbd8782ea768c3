#include "host/apps/gateway/practice.hpp"

#include <utility>

#include "host/apps/gateway/requester.hpp"

namespace liana::gateway {

Practice::Practice(Poller& poller, std::string bench, Answer answer)
    : bench_(std::move(bench)),
      link_(
          poller, bench_, [this](const std::string& packet) { take(packet); }, [this] { lost(); }),
      answer_(std::move(answer)) {}

void Practice::ask(const Json& request, std::optional<std::int64_t> id) {
  const auto refuse = [&](const char* code, const char* why) { answer_(refusal(id, code, why)); };
  if (bench_.empty()) return refuse("refused", "faults are for an arm that liana console simulates");
  const Json& faults = request.member_or_null("faults");
  const bool is_end = request.member_or_null("end") == true;
  if (faults.is_array() == is_end) return refuse("bad_request", "allowed are a list of faults, or end: true");
  if (open_.size() >= kMaxOpen) return refuse("busy", "16 requests wait for their answers; wait for one");
  const std::string packet = is_end ? "\"end\"" : faults.dump(-1, Json::BadUtf8::kReplace);
  if (packet.size() > kMaxBytes) return refuse("bad_request", "the list is over 60000 bytes");
  if (!link_.is_open() && !link_.connect()) return refuse("away", "the simulated arm is not there");
  if (!link_.send(packet)) return refuse("busy", "the simulated arm does not read; wait");
  open_.push_back(id);
}

void Practice::take(const std::string& packet) {
  if (open_.empty()) return;
  const std::optional<std::int64_t> id = open_.front();
  open_.pop_front();
  answer_(answer_from(Json::parse_or_null(packet), id));
}

void Practice::lost() {
  for (const auto& id : std::exchange(open_, {})) answer_(refusal(id, "away", "the simulated arm has ended"));
}

}  // namespace liana::gateway
