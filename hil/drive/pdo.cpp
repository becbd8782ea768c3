#include "hil/drive/pdo.hpp"

#include <algorithm>

namespace liana::bench {

namespace {

constexpr std::int64_t kDisabledBit = 0x80000000;
constexpr std::int64_t kSynchronousTypes = 240;  // 0..240; event types are not supported

std::uint16_t entry_index(std::int64_t entry) { return static_cast<std::uint16_t>(entry >> 16); }
std::uint8_t entry_sub(std::int64_t entry) { return static_cast<std::uint8_t>(entry >> 8); }
std::size_t entry_bits(std::int64_t entry) { return static_cast<std::size_t>(entry & 0xFF); }

std::uint32_t check_entry(const ObjectDictionary& objects, std::int64_t entry, bool receive) {
  const Object* object = objects.find_public(entry_index(entry), entry_sub(entry));
  if (object == nullptr) return abort_code::kNoObject;
  const bool right_way = !receive || object->access != Access::kReadOnly;
  return object->mappable && right_way && entry_bits(entry) == 8 * size_of(object->type) ? abort_code::kNone
                                                                                         : abort_code::kNotMappable;
}

std::uint32_t check_count(const ObjectDictionary& objects, std::uint16_t mapping, std::int64_t count, bool receive) {
  std::size_t bits = 0;
  for (std::int64_t i = 1; i <= count; ++i) {
    const std::int64_t entry = objects.get(mapping, static_cast<std::uint8_t>(i));
    if (check_entry(objects, entry, receive) != abort_code::kNone) return abort_code::kNotMappable;
    bits += entry_bits(entry);
  }
  return bits <= 64 ? abort_code::kNone : abort_code::kPdoLength;
}

}  // namespace

bool is_pdo_object(std::uint16_t index) {
  const int page = index & 0xFF00;
  return (page == 0x1400 || page == 0x1600 || page == 0x1800 || page == 0x1A00) && (index & 0xFF) < kPdoCount;
}

std::uint32_t check_pdo_write(const ObjectDictionary& objects, const Object& object, std::int64_t value) {
  const bool mapping = (object.index & 0x0200) != 0;
  const auto communication = static_cast<std::uint16_t>(object.index & ~0x0200);
  const bool receive = communication < 0x1800;
  const std::int64_t cob = objects.get(communication, 1);
  const bool disabled = (cob & kDisabledBit) != 0;
  if (!mapping && object.sub == 1) {
    const bool same_id = ((cob ^ value) & 0x7FF) == 0;
    return disabled || same_id ? abort_code::kNone : abort_code::kValue;
  }
  if (!disabled) return abort_code::kDeviceState;
  if (!mapping) return object.sub == 2 && value > kSynchronousTypes ? abort_code::kValue : abort_code::kNone;
  if (object.sub == 0) return check_count(objects, object.index, value, receive);
  if (objects.get(object.index, 0) != 0) return abort_code::kUnsupportedAccess;
  return check_entry(objects, value, receive);
}

Pdo::Pdo(ObjectDictionary& objects, std::uint16_t number, bool receive) {
  const auto communication = static_cast<std::uint16_t>((receive ? 0x1400 : 0x1800) + number);
  const auto mapping = static_cast<std::uint16_t>(communication + 0x0200);
  const std::int64_t cob = objects.get(communication, 1);
  enabled_ = (cob & kDisabledBit) == 0;
  cob_id_ = static_cast<std::uint32_t>(cob & 0x7FF);
  every_nth_sync_ = static_cast<std::uint32_t>(objects.get(communication, 2));
  deadline_us_ = 1000 * static_cast<std::uint64_t>(objects.get(communication, 5));
  for (std::int64_t i = 1; i <= objects.get(mapping, 0); ++i) {
    const std::int64_t entry = objects.get(mapping, static_cast<std::uint8_t>(i));
    mapped_.push_back(objects.find_public(entry_index(entry), entry_sub(entry)));
    length_ = static_cast<std::uint8_t>(length_ + size_of(mapped_.back()->type));
  }
}

CanFrame Pdo::pack() const {
  CanFrame frame;
  frame.id = cob_id_;
  frame.length = length_;
  std::uint8_t* to = frame.data.data();
  for (const Object* object : mapped_) {
    put_little_endian(to, size_of(object->type), static_cast<std::uint64_t>(object->value));
    to += size_of(object->type);
  }
  return frame;
}

void Pdo::unpack(const CanFrame& frame) const {
  const std::uint8_t* from = frame.data.data();
  for (Object* object : mapped_) {
    object->value = decode(object->type, from);
    from += size_of(object->type);
  }
}

}  // namespace liana::bench
