// PDOs of a drive: configuration through the object dictionary, packing and unpacking.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hil/drive/can_frame.hpp"
#include "hil/drive/object_dictionary.hpp"

namespace liana::bench {

constexpr std::uint16_t kPdoCount = 4;  // each direction

// True for 0x1400.., 0x1600.., 0x1800.. and 0x1A00...
bool is_pdo_object(std::uint16_t index);
// Whether a PDO object may be given this value now (CiA 301 re-mapping order); an abort code or kNone. The NMT state is
// the caller's business.
std::uint32_t check_pdo_write(const ObjectDictionary& objects, const Object& object, std::int64_t value);

// One PDO as configured at the time of making.
class Pdo {
 public:
  Pdo(ObjectDictionary& objects, std::uint16_t number, bool receive);

  bool enabled() const { return enabled_; }
  std::uint32_t cob_id() const { return cob_id_; }
  std::uint8_t length() const { return length_; }
  // SYNCs between transmissions; 0: at those before which something has changed.
  std::uint32_t every_nth_sync() const { return every_nth_sync_; }
  std::uint64_t deadline_us() const { return deadline_us_; }

  // Mapped objects into a frame, and back. unpack() expects at least length() bytes.
  CanFrame pack() const;
  void unpack(const CanFrame& frame) const;

 private:
  std::vector<Object*> mapped_;
  bool enabled_ = false;
  std::uint32_t cob_id_ = 0;
  std::uint8_t length_ = 0;
  std::uint32_t every_nth_sync_ = 1;
  std::uint64_t deadline_us_ = 0;
};

}  // namespace liana::bench
