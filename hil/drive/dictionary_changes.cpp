#include "hil/drive/dictionary_changes.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

namespace liana::bench {

namespace {

bool is_at(const Object& object, const ObjectPlace& place) {
  return object.index == place.index && (!place.sub || *place.sub == object.sub);
}

std::string name_of(const ObjectPlace& place) {
  char index[8];
  std::snprintf(index, sizeof index, "%04X", place.index);
  return place.sub ? index + (":" + std::to_string(*place.sub)) : index;
}

[[noreturn]] void refuse(const ObjectPlace& place, const std::string& why) {
  throw std::runtime_error(name_of(place) + ": " + why);
}

// Does `change` with every object at the place.
template <typename Change>
void change_at(const ObjectPlace& place, std::vector<Object>& objects, const Change& change) {
  bool found = false;
  for (Object& object : objects) {
    if (!is_at(object, place)) continue;
    change(object);
    found = true;
  }
  if (!found) refuse(place, "the bench's drive has no such object; allowed are those it has and `added` ones");
}

struct Span {
  ObjectType type;
  std::int64_t low;
  std::int64_t high;
};

template <typename Number>
Span span_of(ObjectType type) {
  return {type, std::numeric_limits<Number>::min(), std::numeric_limits<Number>::max()};
}

Span span_of(const AddedObject& added) {
  if (added.type == "u8") return span_of<std::uint8_t>(ObjectType::kU8);
  if (added.type == "i8") return span_of<std::int8_t>(ObjectType::kI8);
  if (added.type == "u16") return span_of<std::uint16_t>(ObjectType::kU16);
  if (added.type == "i16") return span_of<std::int16_t>(ObjectType::kI16);
  if (added.type == "u32") return span_of<std::uint32_t>(ObjectType::kU32);
  if (added.type == "i32") return span_of<std::int32_t>(ObjectType::kI32);
  refuse(added.place, "type " + added.type + ": allowed u8, i8, u16, i16, u32, i32");
}

void add(const AddedObject& added, std::vector<Object>& objects) {
  if (std::any_of(objects.begin(), objects.end(), [&](const Object& each) {
        return each.index == added.place.index && each.sub == added.place.sub.value_or(0);
      }))
    refuse(added.place, "the bench's drive has it already; allowed in `values` and `read_only`");
  const Span span = span_of(added);
  Object object;
  object.index = added.place.index;
  object.sub = added.place.sub.value_or(0);
  object.type = span.type;
  object.access = added.is_read_only ? Access::kReadOnly : Access::kReadWrite;
  object.value = added.value;
  object.low = added.low.value_or(span.low);
  object.high = added.high.value_or(span.high);
  objects.push_back(object);
}

void change_all(const DictionaryConfig& dictionary, std::vector<Object>& objects) {
  for (const AddedObject& added : dictionary.added) add(added, objects);
  for (const ObjectPlace& place : dictionary.absent)
    change_at(place, objects, [](Object& object) { object.is_hidden = true; });
  for (const ObjectPlace& place : dictionary.read_only)
    change_at(place, objects, [](Object& object) { object.access = Access::kReadOnly; });
  for (const auto& [place, value] : dictionary.values)
    change_at({place.index, place.sub.value_or(0)}, objects,
              [number = value](Object& object) { object.value = number; });
}

}  // namespace

void change_objects(const DictionaryConfig& dictionary, std::vector<Object>& objects) {
  try {
    change_all(dictionary, objects);
  } catch (const std::runtime_error& problem) {
    throw std::runtime_error("drive type " + dictionary.drive_type + ": dictionary: " + problem.what());
  }
}

}  // namespace liana::bench
