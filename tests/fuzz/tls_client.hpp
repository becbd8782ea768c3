// The client's end of TLS over a socket that never waits, and a certificate for the other end.
#pragma once

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

namespace liana::fuzz {

// PEM texts, signed by itself.
struct Certificate {
  std::string certificate, key;
};

inline std::string text_of(BIO* memory) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(memory, &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

inline Certificate made_certificate() {
  const std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)> key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const std::unique_ptr<X509, void (*)(X509*)> made(X509_new(), X509_free);
  X509_gmtime_adj(X509_getm_notBefore(made.get()), 0);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), 86400L * 365);
  X509_set_pubkey(made.get(), key.get());
  X509_sign(made.get(), key.get(), EVP_sha256());
  const std::unique_ptr<BIO, int (*)(BIO*)> first(BIO_new(BIO_s_mem()), BIO_free),
      second(BIO_new(BIO_s_mem()), BIO_free);
  PEM_write_bio_X509(first.get(), made.get());
  PEM_write_bio_PrivateKey(second.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  return {text_of(first.get()), text_of(second.get())};
}

class TlsClient {
 public:
  explicit TlsClient(int socket) : ssl_(SSL_new(context()), SSL_free) {
    SSL_set_fd(ssl_.get(), socket);
    SSL_set_connect_state(ssl_.get());
  }
  // One step of the handshake; whether it is done.
  bool shake_hands() {
    ERR_clear_error();
    return SSL_do_handshake(ssl_.get()) == 1;
  }
  void send(std::string_view bytes) {
    ERR_clear_error();
    if (!bytes.empty()) SSL_write(ssl_.get(), bytes.data(), static_cast<int>(bytes.size()));
  }

 private:
  static SSL_CTX* context() {
    static SSL_CTX* const made = [] {
      SSL_CTX* context = SSL_CTX_new(TLS_client_method());
      SSL_CTX_set_verify(context, SSL_VERIFY_NONE, nullptr);
      constexpr std::array<unsigned char, 12> kBoth{2, 'h', '2', 8, 'h', 't', 't', 'p', '/', '1', '.', '1'};
      SSL_CTX_set_alpn_protos(context, kBoth.data(), kBoth.size());
      return context;
    }();
    return made;
  }
  std::unique_ptr<SSL, void (*)(SSL*)> ssl_;
};

}  // namespace liana::fuzz
