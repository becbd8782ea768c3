// Who owns motion: one client at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace liana::server {

// So long an owner may send and read nothing before others may take motion from it, s of this machine's time.
constexpr double kMaxSilence_s = 5.0;

// A client that owns motion, or wants to.
struct Claimant {
  std::uint32_t client = 0;  // 0 = nobody
  // What telecommands carry: client numbers depend on who connected first, roles do not. 0 = nobody.
  std::uint32_t role_number = 0;
  std::string name;          // empty when nobody
  std::int32_t process = 0;  // 0 = not known

  // "'NAME' (process N)".
  std::string text() const;
};

// What lets a client take motion from its owner.
struct TakeOver {
  bool is_allowed = false;     // to this client at all
  std::string from;            // the owner that it names; may be empty
  bool stop_in_force = false;  // an emergency stop
  double silent_s = 0.0;       // for which the owner has sent and read nothing
};

class Owner {
 public:
  // Makes `wanted` the owner. While another one is, motion is taken from it by its name after a stop or kMaxSilence_s
  // of silence, and without its name after both; returns whom it was taken from. Throws RequestError not_owner
  // otherwise.
  std::optional<Claimant> acquire(const Claimant& wanted, const TakeOver& how = {});
  // Gives motion back; throws RequestError not_owner when `client` does not own it.
  void release(std::uint32_t client);
  // The client has died; true when it owned motion (the arm must hold).
  bool gone(std::uint32_t client);
  // Throws RequestError not_owner unless `client` owns motion.
  void require(std::uint32_t client) const;
  std::uint32_t client() const { return now_.client; }
  std::uint32_t role_number() const { return now_.role_number; }
  const std::string& name() const { return now_.name; }

 private:
  bool may_take(const TakeOver& how) const;

  Claimant now_;
};

}  // namespace liana::server
