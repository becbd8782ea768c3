// Who owns motion: one client at a time.
#pragma once

#include <cstdint>
#include <string>

namespace liana::daemon {

class Owner {
 public:
  // Makes `client` the owner; throws RequestError not_owner while another one is.
  void acquire(std::uint32_t client, std::uint32_t role_number, const std::string& name);
  // Gives motion back; throws RequestError not_owner when `client` does not own it.
  void release(std::uint32_t client);
  // The client has died; true when it owned motion (the arm must hold).
  bool gone(std::uint32_t client);
  // Throws RequestError not_owner unless `client` owns motion.
  void require(std::uint32_t client) const;
  // 0 = nobody.
  std::uint32_t client() const { return client_; }
  // What telecommands carry: client numbers depend on who connected first, roles do not. 0 = nobody.
  std::uint32_t role_number() const { return role_number_; }
  // Empty when nobody.
  const std::string& name() const { return name_; }

 private:
  std::uint32_t client_ = 0, role_number_ = 0;
  std::string name_;
};

}  // namespace liana::daemon
