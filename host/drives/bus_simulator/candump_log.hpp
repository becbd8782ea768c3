// A `candump -L` file: one line per frame with its time stamp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "host/drives/bus/can_frame.hpp"

namespace liana::bus_simulator {

constexpr std::size_t kLongestLogLine = 64;

// Formats "(seconds.microseconds) interface id#data\n" into `line`; its length.
std::size_t format_candump(const std::string& interface, const bus::CanFrame& frame,
                           std::array<char, kLongestLogLine>& line);

class CandumpLog {
 public:
  // Creates DIR/<interface>.log; throws std::runtime_error when that is not possible.
  CandumpLog(const std::string& directory, const std::string& interface);
  // Appends a frame at its time_us.
  void write(const bus::CanFrame& frame);
  // Frames lost because the disk did not take them.
  std::uint64_t lost() const { return lost_; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string interface_;
  std::unique_ptr<char[]> buffer_;  // of file_
  std::unique_ptr<std::FILE, Closer> file_;
  std::uint64_t lost_ = 0;
};

}  // namespace liana::bus_simulator
