// Drives as far as the boot sees them: NMT, heartbeat, an object dictionary behind an expedited SDO server. Written for
// the tests alone.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "host/drives/bus/can_frame.hpp"
#include "host/drives/canopen/expected_drive.hpp"

namespace liana::test {

class FakeDrive {
 public:
  explicit FakeDrive(const canopen::ExpectedDrive& is);
  // Has axis 2, with all that axis 1 has.
  void add_axis();

  // What the drive answers.
  std::vector<bus::CanFrame> receive(const bus::CanFrame& frame);
  // The heartbeat, if the drive has been told to send one.
  std::vector<bus::CanFrame> heartbeat() const;

  // Object index << 8 | sub.
  static constexpr std::uint32_t key(std::uint32_t index, std::uint32_t sub) { return index << 8 | sub; }
  struct Object {
    int bytes = 4;
    std::uint32_t value = 0;
  };
  std::map<std::uint32_t, Object> objects;
  std::map<std::uint32_t, std::uint32_t> aborts;  // objects that answer with this code
  std::set<std::uint32_t> stubborn;               // objects that accept writes and ignore them
  std::set<std::uint32_t> read_only;              // objects that refuse writes
  std::vector<std::uint32_t> writes;              // in order
  std::uint8_t node;
  bool dead = false;            // says nothing at all
  std::uint32_t deaf_from = 0;  // does not answer SDO for this object
  int lost_answers = 0;         // so many SDO answers get lost
  bool never_operational = false;
  int restarts = 0;  // boots again at so many writes of 0x6060
  std::uint8_t state = 0x7F;
  int reset_ticks = 0;               // from a reset to the boot-up message; deaf meanwhile
  int answer_ticks = 0;              // from an SDO request to its answer
  std::uint8_t answer_bytes = 8;     // length of its SDO answers
  std::uint8_t heartbeat_bytes = 1;  // and of its heartbeats
  int mode_reads = -1;               // 6061 shows the mode after so many reads; -1: it has what `objects` say

 private:
  bus::CanFrame boot_up() const;
  std::vector<bus::CanFrame> answer_sdo(const bus::CanFrame& request);
};

// An expectation with every field set.
canopen::ExpectedDrive expectation(int bus, std::uint8_t node);

}  // namespace liana::test
