#include "host/control/server/owner.hpp"

#include <cstdio>
#include <utility>

#include "host/api/server/request_error.hpp"

namespace liana::server {

namespace {

std::string process_text(std::int32_t process) {
  return process > 0 ? "process " + std::to_string(process) : "of a process that is not known";
}

}  // namespace

std::string Claimant::text() const { return "'" + name + "' (" + process_text(process) + ")"; }

bool Owner::may_take(const TakeOver& how) const {
  const bool is_silent = how.silent_s >= kMaxSilence_s;
  if (!how.is_allowed) return false;
  if (how.from.empty()) return is_silent && how.stop_in_force;
  return how.from == now_.name && (is_silent || how.stop_in_force);
}

std::optional<Claimant> Owner::acquire(const Claimant& wanted, const TakeOver& how) {
  if (now_.client == 0 || now_.client == wanted.client) {
    now_ = wanted;
    return std::nullopt;
  }
  if (may_take(how)) return std::exchange(now_, wanted);
  char silence[64];
  std::snprintf(silence, sizeof silence, "silent for %.1f s", how.silent_s);
  throw api::RequestError("not_owner", "'" + now_.name + "' owns motion (" + process_text(now_.process) + ", " +
                                           silence + "): it has to give it back (release); a client takes it by name " +
                                           "(acquire with from) after an emergency stop or 5 s of silence");
}

void Owner::release(std::uint32_t client) {
  require(client);
  now_ = {};
}

bool Owner::gone(std::uint32_t client) {
  if (now_.client != client) return false;
  now_ = {};
  return true;
}

void Owner::require(std::uint32_t client) const {
  if (now_.client == client && client != 0) return;
  throw api::RequestError("not_owner", now_.client == 0
                                           ? "nobody owns motion: take it first (acquire)"
                                           : "'" + now_.name + "' owns motion (" + process_text(now_.process) + ")");
}

}  // namespace liana::server
