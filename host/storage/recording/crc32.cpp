#include "host/storage/recording/crc32.hpp"

#include <zlib.h>

namespace liana::recording {

void Crc32::add(std::string_view bytes) noexcept {
  if (bytes.empty()) return;  // zlib takes no bytes at all for the wish to begin anew
  value_ = static_cast<std::uint32_t>(crc32_z(value_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace liana::recording
