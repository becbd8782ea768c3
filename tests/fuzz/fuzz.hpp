// What the fuzz targets share: bytes as the things that parsers take.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace liana::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// The first byte chooses one of several parsers; the others are what it is given.
inline unsigned choice(std::string_view& bytes) {
  if (bytes.empty()) return 0;
  const auto chosen = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  return chosen;
}

// A file in memory for parsers that take a path; one for all runs.
class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("fuzz", 0)), path_("/proc/self/fd/" + std::to_string(fd_)) {}
  // The path of a file with this content.
  const std::string& with(std::string_view content) {
    if (::ftruncate(fd_, 0) != 0 || ::pwrite(fd_, content.data(), content.size(), 0) < 0) std::abort();
    return path_;
  }

 private:
  int fd_;
  std::string path_;
};

// Runs a parser: a refusal in words is a good end; anything else is what is looked for.
template <class Body>
int refusing(const Body& body) {
  try {
    body();
  } catch (const std::runtime_error& refusal) {
    if (*refusal.what() == '\0') std::abort();
  }
  return 0;
}

}  // namespace liana::fuzz
