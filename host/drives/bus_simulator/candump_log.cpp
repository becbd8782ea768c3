#include "host/drives/bus_simulator/candump_log.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace liana::bus_simulator {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

char* put_decimal(char* to, std::uint64_t value, int digits) {
  for (int i = digits - 1; i >= 0; --i, value /= 10) to[i] = static_cast<char>('0' + value % 10);
  return to + digits;
}

char* put_hex(char* to, std::uint32_t value, int digits) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  for (int i = digits - 1; i >= 0; --i, value >>= 4) to[i] = kDigits[value & 15U];
  return to + digits;
}

}  // namespace

std::size_t format_candump(const std::string& interface, const bus::CanFrame& frame,
                           std::array<char, kLongestLogLine>& line) {
  char* to = line.data();
  *to++ = '(';
  to = put_decimal(to, frame.time_us / 1'000'000, 10);
  *to++ = '.';
  to = put_decimal(to, frame.time_us % 1'000'000, 6);
  *to++ = ')';
  *to++ = ' ';
  to = std::copy_n(interface.begin(), std::min<std::size_t>(interface.size(), 15), to);
  *to++ = ' ';
  const bool is_error = (frame.id & bus::kCanErrorFlag) != 0;
  const bool extended = (frame.id & bus::kCanExtendedFlag) != 0;
  const std::uint32_t mask = is_error   ? bus::kCanErrorFlag | bus::kCanExtendedMask
                             : extended ? bus::kCanExtendedMask
                                        : bus::kCanStandardMask;
  to = put_hex(to, frame.id & mask, extended || is_error ? 8 : 3);
  *to++ = '#';
  const bool remote = (frame.id & bus::kCanRemoteFlag) != 0;
  if (remote) *to++ = 'R';
  for (std::size_t i = 0; !remote && i < frame.length; ++i) to = put_hex(to, frame.data[i], 2);
  *to++ = '\n';
  return static_cast<std::size_t>(to - line.data());
}

CandumpLog::CandumpLog(const std::string& directory, const std::string& interface)
    : interface_(interface),
      buffer_(std::make_unique<char[]>(kBufferBytes)),
      file_(std::fopen((directory + "/" + interface + ".log").c_str(), "we")) {
  if (!file_) {
    throw std::runtime_error(directory + "/" + interface + ".log: cannot be written: " + std::strerror(errno) +
                             "; give --log a directory that exists and may be written");
  }
  std::setvbuf(file_.get(), buffer_.get(), _IOFBF, kBufferBytes);
}

void CandumpLog::write(const bus::CanFrame& frame) {
  std::array<char, kLongestLogLine> line;
  const std::size_t size = format_candump(interface_, frame, line);
  if (std::fwrite(line.data(), 1, size, file_.get()) != size) ++lost_;
}

}  // namespace liana::bus_simulator
