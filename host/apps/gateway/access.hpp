// Who may do what: roles of the console, and the file that gives them to people.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace liana::gateway {

enum class Access : std::uint8_t {
  kWatch,       // looks, and may stop the arm
  kOperate,     // whatever a client of lianad may ask, and device samples
  kAdminister,  // also ends lianad
};

// watch, operate, administer.
const char* access_name(Access access);

// Whether it may send the request `op` of docs/reference/api.md. (Others than this may refuse it, too: lianad has the
// last word.)
bool may_ask(Access access, std::string_view op);

struct Token {
  Access access = Access::kWatch;
  std::string secret;
};

using Tokens = std::map<std::string, Token, std::less<>>;  // by name

// Lines `name role token`; empty ones and those that begin with # count for nothing. Names: 1 to 32 letters, digits,
// _ - or .; tokens: 16 to 128 printable characters. Throws std::runtime_error, also when others than the owner may
// read or write the file.
Tokens read_tokens(const std::string& file);

}  // namespace liana::gateway
