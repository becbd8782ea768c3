#include "host/apps/gateway/proof.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <sys/random.h>

#include <array>
#include <span>
#include <stdexcept>

namespace liana::gateway {
namespace {

std::string hex(std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace

std::string fresh_nonce() {
  std::array<unsigned char, 32> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers");
  return hex(bytes);
}

std::string proof_of(std::string_view token, std::string_view nonce) {
  std::array<unsigned char, 32> digest{};
  unsigned int size = 0;
  const auto* text = reinterpret_cast<const unsigned char*>(nonce.data());
  if (HMAC(EVP_sha256(), token.data(), static_cast<int>(token.size()), text, nonce.size(), digest.data(), &size) ==
      nullptr)
    throw std::runtime_error("HMAC-SHA256 failed");
  return hex(digest);
}

bool same_in_constant_time(std::string_view a, std::string_view b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace liana::gateway
