#include "hil/drive/object_dictionary.hpp"

#include <algorithm>
#include <utility>

#include "hil/drive/can_frame.hpp"

namespace liana::bench {

namespace {

std::uint32_t key_of(std::uint16_t index, std::uint8_t sub) { return std::uint32_t{index} << 8 | sub; }

}  // namespace

std::size_t size_of(ObjectType type) {
  switch (type) {
    case ObjectType::kU8:
    case ObjectType::kI8:
      return 1;
    case ObjectType::kU16:
    case ObjectType::kI16:
      return 2;
    case ObjectType::kU32:
    case ObjectType::kI32:
      return 4;
    case ObjectType::kText:
      break;
  }
  return 0;
}

std::int64_t decode(ObjectType type, const std::uint8_t* bytes) {
  const std::uint64_t raw = get_little_endian(bytes, size_of(type));
  switch (type) {
    case ObjectType::kI8:
      return static_cast<std::int8_t>(raw);
    case ObjectType::kI16:
      return static_cast<std::int16_t>(raw);
    case ObjectType::kI32:
      return static_cast<std::int32_t>(raw);
    default:
      return static_cast<std::int64_t>(raw);
  }
}

int axis_of_object(std::uint16_t index) {
  if (index >= 0x6000 && index < 0x7000) return index < 0x6800 ? 1 : 2;
  const int number = index & 0x1FF;  // of a PDO, from 0
  if (index < 0x1400 || index >= 0x1C00 || number >= 0x80) return 0;
  return number < 0x40 ? 1 : 2;
}

ObjectDictionary::ObjectDictionary(std::vector<Object> objects, int axis) : axis_(axis), objects_(std::move(objects)) {
  std::sort(objects_.begin(), objects_.end(),
            [](const Object& a, const Object& b) { return key_of(a.index, a.sub) < key_of(b.index, b.sub); });
  for (const Object& object : objects_) keys_.push_back(key_of(object.index, object.sub));
}

const Object* ObjectDictionary::find(std::uint16_t index, std::uint8_t sub) const {
  const std::uint32_t key = key_of(index, sub);
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  return found != keys_.end() && *found == key ? &objects_[static_cast<std::size_t>(found - keys_.begin())] : nullptr;
}

Object* ObjectDictionary::find(std::uint16_t index, std::uint8_t sub) {
  return const_cast<Object*>(std::as_const(*this).find(index, sub));
}

// Of axis 2: 0, which is no object, for what is axis 1's.
std::uint16_t ObjectDictionary::own_index(std::uint16_t index) const {
  const int axis = axis_of_object(index);
  if (axis_ == 1 || axis == 0) return index;
  if (axis != axis_) return 0;
  return static_cast<std::uint16_t>(index - (index >= 0x6000 ? 0x800 : 0x40));
}

const Object* ObjectDictionary::find_public(std::uint16_t index, std::uint8_t sub) const {
  const Object* object = find(own_index(index), sub);
  return object == nullptr || object->is_hidden ? nullptr : object;
}

Object* ObjectDictionary::find_public(std::uint16_t index, std::uint8_t sub) {
  return const_cast<Object*>(std::as_const(*this).find_public(index, sub));
}

std::uint32_t ObjectDictionary::missing(std::uint16_t index) const {
  const bool known = std::any_of(objects_.begin(), objects_.end(), [own = own_index(index)](const Object& object) {
    return object.index == own && !object.is_hidden;
  });
  return known ? abort_code::kNoSub : abort_code::kNoObject;
}

std::uint32_t ObjectDictionary::check_read(std::uint16_t index, std::uint8_t sub) const {
  const Object* object = find_public(index, sub);
  if (object == nullptr) return missing(index);
  return object->access == Access::kWriteOnly ? abort_code::kWriteOnly : abort_code::kNone;
}

std::uint32_t ObjectDictionary::check_write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* bytes,
                                            std::size_t size) const {
  const Object* object = find_public(index, sub);
  if (object == nullptr) return missing(index);
  if (object->access == Access::kReadOnly) return abort_code::kReadOnly;
  if (size != size_of(object->type)) return size > size_of(object->type) ? abort_code::kTooLong : abort_code::kTooShort;
  const std::int64_t value = decode(object->type, bytes);
  if (value > object->high) return abort_code::kTooHigh;
  if (value < object->low) return abort_code::kTooLow;
  return abort_code::kNone;
}

}  // namespace liana::bench
