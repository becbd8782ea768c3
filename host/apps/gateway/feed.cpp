#include "host/apps/gateway/feed.hpp"

#include <cstdio>
#include <utility>

#include "host/api/telemetry/record.hpp"

namespace liana::gateway {

namespace {

constexpr const char* kNotThere = "lianad is not there: the arm's controller has ended or was never started";
constexpr const char* kNotYet =
    "lianad is there, but the arm's time has not begun: it waits for a program that belongs to the run";

// No text within a JSON text can look like this: its quotes would be escaped.
bool is_state(const std::string& packet) { return packet.find(R"("op":"state")") != std::string::npos; }

Json hello() {
  return {{"op", "hello"},
          {"name", "gateway"},
          {"role", "observer"},
          {"lockstep", false},
          {"subscribe", {"state", "event"}},
          {"events_from", 1}};
}

}  // namespace

Feed::Feed(Poller& poller, const std::string& api, std::function<void()> changed)
    : link_(
          poller, api, [this](const std::string& packet) { take(packet); }, [this] { lost(); }),
      changed_(std::move(changed)),
      away_(kNotThere) {}

void Feed::connect() {
  if (!link_.is_open() && link_.connect()) link_.send(hello().dump());
}

void Feed::take(const std::string& packet) {
  if (is_state(packet)) {
    newest_state_ = packet;
    is_recorded_ = false;
    is_new_ = true;
  } else {
    take_other(packet);
  }
}

void Feed::take_other(const std::string& packet) {
  const Json message = Json::parse_or_null(packet);
  const std::string op = message.value("op", "");
  if (op == "event") keep_event(packet);
  if (op == "error") say(message.value("message", ""));
  if (op != "welcome") return;
  said_.clear();
  lianad_says_ = message;
  welcome_ = Json();
  newest_state_.clear();
  events_.clear();
  next_event_ = message.at("events").value("oldest", std::uint64_t{1});
  away_ = kNotYet;
  changed_();
}

// What stands is said once: after a refusal hello is said again and again.
void Feed::say(const std::string& problem) {
  if (problem != said_) std::fprintf(stderr, "liana-gateway: lianad: %s\n", problem.c_str());
  said_ = problem;
}

// lianad sends them in order and each once; what it had lost itself leaves a gap, which clients are told of as such.
void Feed::keep_event(const std::string& packet) {
  const auto sequence = Json::parse(packet).value("sequence", std::uint64_t{0});
  if (sequence != next_event_) events_.clear();
  events_.push_back(packet);
  if (events_.size() > kKeptEvents) events_.pop_front();
  next_event_ = sequence + 1;
  changed_();
}

void Feed::begin_life(const Json& state) {
  layout_ = telemetry::layout_of(state);
  welcome_ = {{"op", "welcome"}, {"protocol", 1}, {"layout", telemetry::to_json(*layout_)}};
  for (const char* key : {"robot", "scene", "buses", "period_s", "interval_ticks", "time_mode", "config_hash"})
    welcome_[key] = lianad_says_.member_or_null(key);
  away_.clear();
  facts_ = Json();
  ++life_;
}

void Feed::publish(double now_s, bool wanted) {
  if (std::exchange(is_new_, false)) heard_s_ = now_s;
  if (newest_state_.empty() || is_recorded_ || !wanted || now_s - published_s_ < kMinBetween_s) return;
  Json state = Json::parse(newest_state_);
  is_recorded_ = true;
  if (welcome_.is_null()) begin_life(state);
  record_ = telemetry::encode(*layout_, state, ++sequence_, facts_number_);
  Json facts = telemetry::facts_of(std::move(state));  // a copy would cost a third of all this
  if (!(facts == facts_)) {
    facts_ = std::move(facts);
    telemetry::set_facts(record_, ++facts_number_);
    facts_message_ = Json{{"op", "facts"}, {"facts", facts_number_}, {"state", facts_}}.dump();
  }
  published_s_ = now_s;
  changed_();
}

void Feed::lost() {
  away_ = kNotThere;
  welcome_ = Json();
  newest_state_.clear();
  record_.clear();
  changed_();
}

}  // namespace liana::gateway
