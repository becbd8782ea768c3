#include "host/storage/recording/compression.hpp"

#include <stdexcept>

#ifdef LIANA_WITH_ZSTD
#include <zstd.h>
#endif

namespace liana::recording {

namespace {

[[noreturn]] void refuse(std::string_view compression, const char* why) {
  throw std::runtime_error("recording: a chunk compressed with '" + std::string(compression) + "': " + why);
}

#ifdef LIANA_WITH_ZSTD
std::string unzstd(std::string_view compressed, std::uint64_t size) {
  if (ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != size)
    refuse("zstd", "damaged; take a good copy of the file");
  std::string plain(size, '\0');
  const std::size_t got = ZSTD_decompress(plain.data(), plain.size(), compressed.data(), compressed.size());
  if (ZSTD_isError(got) != 0 || got != size) refuse("zstd", "damaged; take a good copy of the file");
  return plain;
}
#else
std::string unzstd(std::string_view, std::uint64_t) {
  refuse("zstd", "this build has no zstd; install libzstd-dev and build again");
}
#endif

}  // namespace

#ifdef LIANA_WITH_ZSTD
const char* compression_name() { return "zstd"; }

std::string compress(std::string_view plain, int level) {
  std::string out(ZSTD_compressBound(plain.size()), '\0');
  const std::size_t length = ZSTD_compress(out.data(), out.size(), plain.data(), plain.size(), level);
  if (ZSTD_isError(length) != 0) refuse("zstd", ZSTD_getErrorName(length));
  out.resize(length);
  return out;
}
#else
const char* compression_name() { return ""; }

std::string compress(std::string_view plain, int) { return std::string(plain); }
#endif

std::string decompress(std::string_view compressed, std::string_view compression, std::uint64_t size) {
  if (compression == "zstd") return unzstd(compressed, size);
  if (!compression.empty()) refuse(compression, "known are zstd and none");
  if (compressed.size() != size) refuse("", "damaged; take a good copy of the file");
  return std::string(compressed);
}

}  // namespace liana::recording
