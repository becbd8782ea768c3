#include "host/apps/run_page/deflate.hpp"

#include <zlib.h>

#include <cstdint>
#include <stdexcept>

namespace liana::run_page {

std::string deflated(std::string_view bytes) {
  constexpr int kRaw = -15, kMaxMemory = 9, kLevel = 7;
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kRaw, kMaxMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("no memory to compress " + std::to_string(bytes.size()) + " bytes");
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not write there
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int done = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (done != Z_STREAM_END)
    throw std::runtime_error("zlib could not compress " + std::to_string(bytes.size()) + " bytes");
  return out;
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out.push_back(i + k <= bytes.size() ? kLetters[three >> (18 - 6 * k) & 63u] : '=');
  }
  return out;
}

}  // namespace liana::run_page
