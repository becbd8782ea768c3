// Who knows a token proves it without sending it: HMAC-SHA256 over a number that is used once.
#pragma once

#include <string>
#include <string_view>

namespace liana::gateway {

// 32 random bytes as 64 hexadecimal digits.
std::string fresh_nonce();

// HMAC-SHA256 (RFC 2104) with the bytes of the token as the key, over the nonce's digits as they were sent; 64
// hexadecimal digits in lower case.
std::string proof_of(std::string_view token, std::string_view nonce);

// What a client with this ticket shows for the page of one run: the page, whoever wrote it, reads it in its own address
// and can load nothing else by it.
inline std::string run_ticket(std::string_view ticket, std::string_view run) { return proof_of(ticket, run); }

// Whether two texts are the same, in a time that does not depend on where they differ.
bool same_in_constant_time(std::string_view a, std::string_view b);

}  // namespace liana::gateway
