#include "host/base/text/text_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

#include "host/base/text/printable.hpp"

namespace liana::text {
namespace {

// One of the two streams.
struct Printed {
  int fd;
  std::string rest;  // of a character that the last write cut off
};

ssize_t write_text(void* cookie, const char* bytes, std::size_t count) {
  auto& printed = *static_cast<Printed*>(cookie);
  const std::string text = printable_piece({bytes, count}, printed.rest);
  for (std::string_view left = text; !left.empty();) {
    const ssize_t done = ::write(printed.fd, left.data(), left.size());
    if (done < 0 && errno != EINTR) return 0;  // as fopencookie() has it
    left.remove_prefix(done > 0 ? static_cast<std::size_t>(done) : 0);
  }
  return static_cast<ssize_t>(count);
}

std::FILE* text_stream(Printed& printed, int buffering) {
  std::FILE* const stream = fopencookie(&printed, "w", {nullptr, write_text, nullptr, nullptr});
  if (stream == nullptr) throw std::runtime_error("no memory for a stream");
  std::setvbuf(stream, nullptr, buffering, BUFSIZ);
  return stream;
}

}  // namespace

void print_only_text() {
  static Printed out{STDOUT_FILENO, ""}, error{STDERR_FILENO, ""};
  stdout = text_stream(out, isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF);
  stderr = text_stream(error, _IONBF);
}

}  // namespace liana::text
