#include "host/apps/gateway/requester.hpp"

#include <utility>

namespace liana::gateway {

Json refusal(std::optional<std::int64_t> id, const std::string& code, const std::string& message) {
  Json answer{{"op", "answer"}, {"ok", false}, {"code", code}, {"message", message}};
  if (id) answer["id"] = *id;
  return answer;
}

Json answer_from(const Json& lianad_says, std::optional<std::int64_t> id) {
  if (lianad_says.value("op", "") != "ok")
    return refusal(id, lianad_says.value("code", ""), lianad_says.value("message", ""));
  Json fields = lianad_says;
  fields.erase("op");
  fields.erase("id");
  Json answer{{"op", "answer"}, {"ok", true}, {"answer", std::move(fields)}};
  if (id) answer["id"] = *id;
  return answer;
}

Requester::Requester(Poller& poller, const std::string& api, std::string name, std::string role, Answer answer)
    : link_(
          poller, api, [this](const std::string& packet) { take(packet); }, [this] { lost(); }),
      name_(std::move(name)),
      role_(std::move(role)),
      answer_(std::move(answer)) {}

bool Requester::connect() {
  if (link_.is_open()) return true;
  if (!link_.connect()) return false;
  is_welcome_ = false;
  const Json hello{
      {"op", "hello"}, {"name", name_}, {"role", role_}, {"lockstep", false}, {"subscribe", Json::array()}};
  return link_.send(hello.dump());
}

void Requester::ask(Json request, std::optional<std::int64_t> id) {
  if (!connect()) return refuse(id, "away", "lianad is not there; nothing was asked of the arm");
  if (open_.size() >= kMaxOpen) return refuse(id, "busy", "64 requests wait for their answers; wait for one");
  request.erase("id");
  if (id) request["id"] = ++last_number_;
  std::string packet = request.dump(-1, Json::BadUtf8::kReplace);
  if (packet.size() > api::kMaxPacketBytes) return refuse(id, "bad_request", "the request is over 131072 bytes");
  if (!link_.send(std::move(packet))) return refuse(id, "busy", "lianad does not read; nothing was asked of the arm");
  if (id) open_[last_number_] = *id;
}

void Requester::take(const std::string& packet) {
  const Json message = Json::parse_or_null(packet);
  const std::string op = message.value("op", "");
  if (op == "welcome") is_welcome_ = true;
  if (op != "ok" && op != "error") return;  // its welcome
  const Json* number = message.find("id");
  if (number == nullptr) {
    if (op == "error") answer_(answer_from(message, std::nullopt));
    if (!is_welcome_) leave();  // another has the role: the next request tries again
    return;
  }
  const auto found = open_.find(number->get<std::uint64_t>());
  if (found == open_.end()) return;
  const std::int64_t id = found->second;
  open_.erase(found);
  answer_(answer_from(message, id));
}

void Requester::leave() {
  link_.close();
  lost();
}

void Requester::lost() {
  for (const auto& [number, id] : std::exchange(open_, {}))
    refuse(id, "away", "lianad has left; whether it acted on the request is not known");
}

void Requester::refuse(std::optional<std::int64_t> id, const char* code, const std::string& message) {
  answer_(refusal(id, code, message));
}

}  // namespace liana::gateway
