#include "host/daemon/owner.hpp"

#include "host/api/request_error.hpp"

namespace liana::daemon {

void Owner::acquire(std::uint32_t client, std::uint32_t role_number, const std::string& name) {
  if (client_ != 0 && client_ != client)
    throw api::RequestError("not_owner", "'" + name_ + "' owns motion; it has to give it back first (release)");
  client_ = client;
  role_number_ = role_number;
  name_ = name;
}

void Owner::release(std::uint32_t client) {
  require(client);
  client_ = role_number_ = 0;
  name_.clear();
}

bool Owner::gone(std::uint32_t client) {
  if (client_ != client) return false;
  client_ = role_number_ = 0;
  name_.clear();
  return true;
}

void Owner::require(std::uint32_t client) const {
  if (client_ == client && client != 0) return;
  throw api::RequestError("not_owner",
                          client_ == 0 ? "nobody owns motion: take it first (acquire)" : "'" + name_ + "' owns motion");
}

}  // namespace liana::daemon
