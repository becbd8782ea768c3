// One client's own connection to lianad in one role: made when it first asks for something, so that lianad knows who
// owns motion and holds the arm when that client is gone.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "host/apps/gateway/api_connection.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {

class Requester {
 public:
  static constexpr std::size_t kMaxOpen = 64;  // requests that lianad has not answered yet

  // Gets an answer to the client: {"op":"answer","id":...,"ok":...}.
  using Answer = std::function<void(const Json& answer)>;

  // `role` is one of docs/reference/api.md. `poller` must outlive this.
  Requester(Poller& poller, const std::string& api, std::string name, std::string role, Answer answer);

  // Makes the connection unless it is there; false when lianad cannot be reached.
  bool connect();
  // Gives the role back, for others to have; requests that are open are answered with `away`.
  void leave();
  // Passes a request on. Without `id` only an error is answered, as lianad does.
  void ask(Json request, std::optional<std::int64_t> id);

 private:
  void take(const std::string& packet);
  void lost();
  void refuse(std::optional<std::int64_t> id, const char* code, const std::string& message);

  ApiConnection link_;
  std::string name_, role_;
  Answer answer_;
  bool is_welcome_ = false;
  std::uint64_t last_number_ = 0;
  std::map<std::uint64_t, std::int64_t> open_;  // number at lianad: id of the client
};

// {"op":"answer","ok":false,"code":...,"message":...}, with the id where there is one.
Json refusal(std::optional<std::int64_t> id, const std::string& code, const std::string& message);

// The answer to a client, from lianad's `ok` or `error`.
Json answer_from(const Json& lianad_says, std::optional<std::int64_t> id);

}  // namespace liana::gateway
