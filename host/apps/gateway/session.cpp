#include "host/apps/gateway/session.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "host/api/server/request_error.hpp"
#include "host/api/server/stop_packet.hpp"
#include "host/apps/gateway/proof.hpp"

namespace liana::gateway {
namespace {

constexpr std::uint16_t kPolicyViolated = 1008, kTooBig = 1009;  // RFC 6455, section 7.4.1
constexpr std::size_t kLongestName = 32;
constexpr double kMinHz = 0.1, kMaxHz = 100.0;
constexpr double kEarly_s = 0.005;  // states do not come to the millisecond

bool is_good_name(const std::string& name) {
  return !name.empty() && name.size() <= kLongestName && std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
}

std::string text_of(const Json& message, const char* key) {
  const Json& value = message.member_or_null(key);
  return value.is_string() ? value.text() : "";
}

std::optional<std::int64_t> id_of(const Json& message) {
  const Json& id = message.member_or_null("id");
  if (id.is_null()) return std::nullopt;
  return id.get<std::int64_t>();
}

}  // namespace

Session::Session(House& house, std::string address, double now_s, std::function<void()> something_to_send)
    : house_(house),
      address_(std::move(address)),
      nonce_(fresh_nonce()),
      since_s_(now_s),
      something_to_send_(std::move(something_to_send)),
      heard_s_(now_s) {
  answer({{"op", "challenge"}, {"nonce", nonce_}, {"loopback", house.is_loopback}, {"proof", house.tokens != nullptr}});
}

void Session::take_text(std::string_view text, double now_s) {
  heard_s_ = now_s;
  ++messages_;
  std::optional<std::int64_t> id;
  try {
    const Json message = Json::parse(text);
    const std::string op = text_of(message, "op");
    id = id_of(message);
    if (!greeted_) return op == "hello" ? hello(message) : close(kPolicyViolated, "no_hello", "say hello first");
    if (op == "request" && text_of(message.member_or_null("request"), "op") == "stop")
      return stop(message["request"], id, now_s);
    if (op == "request") return request(message, id, now_s);
    if (op == "stop") return stop(message, id, now_s);
    if (op == "pace") return pace(message);
    malformed(now_s, id, "op '" + op + "': allowed request, stop, pace");
  } catch (const JsonError& error) {
    // Whoever wants to stop the arm is not sent back to correct the spelling.
    const api::StopPacket wanted = greeted_ ? api::read_stop(text) : api::StopPacket{};
    if (wanted.is_stop) return stop_->press(now_s, id, wanted.reason);
    malformed(now_s, id, error.what());
  }
}

// Four bytes: the sequence of a record that has arrived; those before it have, too.
void Session::take_binary(std::string_view bytes, double now_s) {
  heard_s_ = now_s;
  ++messages_;
  std::uint32_t sequence = 0;
  if (!greeted_) return close(kPolicyViolated, "no_hello", "say hello first");
  if (bytes.size() != sizeof sequence) return malformed(now_s, std::nullopt, "a record is answered with 4 bytes");
  std::memcpy(&sequence, bytes.data(), sizeof sequence);
  const auto found = std::find(in_flight_.begin(), in_flight_.end(), sequence);
  if (found == in_flight_.end()) return malformed(now_s, std::nullopt, "no such record is under way");
  const bool was_waiting = in_flight_.size() == kCredits;
  in_flight_.erase(in_flight_.begin(), found + 1);
  if (was_waiting) something_to_send_();
}

void Session::refuse_oversized(double now_s) {
  heard_s_ = now_s;
  close(kTooBig, "too_large", "a message of over 131072 bytes");
}

void Session::hello(const Json& message) {
  const bool has_tokens = house_.tokens != nullptr;
  if (has_tokens && !is_proven(message)) return;
  const std::string wanted = has_tokens ? text_of(message, "token_name") : text_of(message, "name");
  if (!is_good_name(wanted))
    return close(kPolicyViolated, "malformed", "name: allowed is a text of 1 to 32 bytes without control characters");
  access_ = has_tokens ? house_.tokens->find(wanted)->second.access : Access::kOperate;
  name_ = house_.free_name(wanted);
  if (has_tokens) ticket_ = fresh_nonce();
  greeted_ = true;
  const auto reply = [this](const Json& said) { answer(said); };
  stop_.emplace(house_.poller, house_.api, name_, reply);
  client_.emplace(house_.poller, house_.api, name_, "client", reply);
  operator_.emplace(house_.poller, house_.api, name_, "operator", reply);
  handles_.emplace(house_.poller, house_.devices, name_,
                   [this](const std::string& why) { answer(refusal(std::nullopt, "refused", why)); });
  planner_.emplace(house_.programs.planner, reply);
  practice_.emplace(house_.poller, house_.programs.practice, reply);
  something_to_send_();
}

// One try: another needs another nonce.
bool Session::is_proven(const Json& message) {
  const std::string proof = text_of(message, "proof");
  const auto token = house_.tokens->find(text_of(message, "token_name"));
  const bool known = token != house_.tokens->end();
  const std::string wanted = proof_of(known ? token->second.secret : nonce_, nonce_);
  if (known && same_in_constant_time(proof, wanted)) return true;
  close(kPolicyViolated, proof.empty() ? "no_token" : "wrong_proof",
        proof.empty() ? "this gateway asks for a token" : "no token of this name, or another one");
  return false;
}

void Session::request(const Json& message, std::optional<std::int64_t> id, double now_s) {
  const Json& wanted = message.at("request");
  const std::string op = text_of(wanted, "op");
  if (!may_ask(access_, op)) {
    house_.refused("wrong_role", address_, name_ + " (" + access_name(access_) + ") asked for " + op);
    return answer(refusal(id, "not_allowed", "'" + op + "' is not for the role " + access_name(access_)));
  }
  if (op == "device") return carry_out(id, [&] { handles_->take(wanted); });
  if (op == "plan" || op == "end_plan") return carry_out(id, [&] { plan(wanted, now_s); });
  if (op == "practice") return practice_->ask(wanted, id);
  if (op == "use_device") choose(wanted);
  (op == "operator_says" ? operator_ : client_)->ask(wanted, id);
  if (op != "release") return;
  operator_->leave();  // one operator at a time: whoever takes motion next may steer
  handles_->leave();
}

// What the gateway does by itself, such as taking samples of the page's own handles, is answered at once.
void Session::carry_out(std::optional<std::int64_t> id, const std::function<void()>& wanted) {
  try {
    wanted();
    if (id) answer({{"op", "answer"}, {"id", *id}, {"ok", true}, {"answer", Json::object()}});
  } catch (const api::RequestError& error) {
    answer(refusal(id, error.code(), error.what()));
  }
}

// A way to a goal of angles: what becomes of it comes as messages.
void Session::plan(const Json& wanted, double now_s) {
  if (text_of(wanted, "op") != "plan") return planner_->end("Planning was cancelled.");
  planner_->start(wanted, house_.feed.welcome(), Json::parse_or_null(house_.feed.state()), name_, now_s);
}

// lianad looks for a device before it lets one steer: the page's handles are there before they are asked for. Where
// lianad is away the request is answered with that.
void Session::choose(const Json& wanted) {
  if (text_of(wanted, "device") != "vr") return handles_->leave();
  try {
    handles_->connect();
  } catch (const api::RequestError& error) {
    answer(refusal(std::nullopt, error.code(), error.what()));
  }
}

void Session::stop(const Json& message, std::optional<std::int64_t> id, double now_s) {
  const Json& reason = message.member_or_null("reason");
  stop_->press(now_s, id, reason.is_string() ? reason.text() : reason.is_null() ? "" : reason.dump());
}

void Session::pace(const Json& message) {
  const double hz = message.at("hz");
  if (!(hz >= kMinHz && hz <= kMaxHz)) throw JsonError("hz = " + message["hz"].dump() + ": allowed 0.1 to 100");
  period_s_ = 1.0 / hz;
}

void Session::malformed(double now_s, std::optional<std::int64_t> id, const std::string& why) {
  malformed_ = std::max(0.0, malformed_ - (now_s - malformed_s_) * kMaxMalformed / 10.0) + 1.0;
  malformed_s_ = now_s;
  house_.refused("malformed", address_, why);
  if (malformed_ > kMaxMalformed) return close(kPolicyViolated, "malformed", "too many malformed messages");
  answer(refusal(id, "bad_request", why));
}

void Session::answer(const Json& message) {
  answers_.push_back(message.dump(-1, Json::BadUtf8::kReplace));
  answer_bytes_ += answers_.back().size();
  if (answer_bytes_ > kMaxAnswerBytes) close(kPolicyViolated, "silent", "does not read its answers");
  something_to_send_();
}

void Session::close(std::uint16_t code, std::string_view what, const std::string& text) {
  if (end_.code != 0) return;
  end_ = {code, text};
  house_.refused(what, address_, (name_.empty() ? "" : name_ + ": ") + text);
  something_to_send_();
}

void Session::tick(double now_s) {
  const bool goes_on = has_said_much();
  messages_ = 0;
  if (goes_on) something_to_send_();
  if (!greeted_ && now_s - since_s_ > kHelloPatience_s) close(kPolicyViolated, "no_hello", "no hello within 5 s");
  if (in_flight_.size() == kCredits && now_s - std::max(heard_s_, record_s_) > kSilent_s)
    close(kPolicyViolated, "silent", "has answered nothing for 10 s");
  if (stop_) stop_->tick(now_s);
  if (planner_ && planner_->is_running()) planner_->tick(Json::parse_or_null(house_.feed.state()), name_, now_s);
}

bool Session::has_more() const {
  const Feed& feed = house_.feed;
  if (!greeted_ || !answers_.empty()) return !answers_.empty();
  if (!feed.away().empty()) return away_ != feed.away();
  return life_ != feed.life() || next_event_ < feed.next_event() || facts_sent_ != feed.facts_number() ||
         record_sent_ != feed.sequence();
}

std::optional<Outgoing> Session::next(double now_s) {
  if (!answers_.empty()) {
    sending_ = std::move(answers_.front());
    answers_.pop_front();
    answer_bytes_ -= sending_.size();
    return Outgoing{sending_, false};
  }
  if (!greeted_) return std::nullopt;
  if (take_news()) return Outgoing{sending_, false};
  if (life_ != house_.feed.life() || !house_.feed.away().empty()) return std::nullopt;
  if (take_event()) return Outgoing{sending_, false};
  if (facts_sent_ != house_.feed.facts_number()) {
    facts_sent_ = house_.feed.facts_number();
    return Outgoing{house_.feed.facts(), false};
  }
  return record(now_s);
}

// That lianad has left, or that a new life of it has begun.
bool Session::take_news() {
  const Feed& feed = house_.feed;
  if (!feed.away().empty()) {
    if (std::exchange(away_, feed.away()) == feed.away()) return false;
    sending_ = Json{{"op", "away"}, {"text", away_}}.dump();
    return true;
  }
  away_.clear();
  if (life_ == feed.life()) return false;
  life_ = feed.life();
  next_event_ = feed.oldest_event();
  facts_sent_ = 0;
  sending_ = welcome();
  return true;
}

std::string Session::welcome() const {
  Json message = house_.feed.welcome();
  message["role"] = access_name(access_);
  message["name"] = name_;
  if (!ticket_.empty()) message["ticket"] = ticket_;
  if (!house_.programs.practice.empty()) message["practice"] = true;
  return message.dump();
}

bool Session::take_event() {
  const Feed& feed = house_.feed;
  if (next_event_ < feed.oldest_event()) {
    const std::uint64_t to = feed.oldest_event() - 1;
    sending_ = Json{{"op", "events_lost"}, {"from", next_event_}, {"to", to}, {"count", to - next_event_ + 1}}.dump();
    next_event_ = to + 1;
    return true;
  }
  if (next_event_ >= feed.next_event()) return false;
  sending_ = feed.event(next_event_++);
  return true;
}

std::optional<Outgoing> Session::record(double now_s) {
  const std::uint32_t sequence = house_.feed.sequence();
  const bool is_due = now_s - record_s_ >= period_s_ - kEarly_s;
  if (sequence == 0 || sequence == record_sent_ || in_flight_.size() >= kCredits || !is_due) return std::nullopt;
  record_sent_ = sequence;
  record_s_ = now_s;
  in_flight_.push_back(sequence);
  return Outgoing{house_.feed.record(), true};
}

}  // namespace liana::gateway
