// A request that is answered with an error: named code and one clear sentence.
#pragma once

#include <stdexcept>
#include <string>

namespace liana::api {

// Codes of docs/reference/api.md: bad_request, not_owner, not_enabled, fault, busy, out_of_range, refused, no_device.
class RequestError : public std::runtime_error {
 public:
  RequestError(std::string code, const std::string& message) : std::runtime_error(message), code_(std::move(code)) {}
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

}  // namespace liana::api
