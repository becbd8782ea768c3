#include "hil/config/dictionary_config.hpp"

#include <cmath>

#include "hil/config/fields.hpp"
#include "hil/config/json_file.hpp"

namespace liana::bench {

namespace {

constexpr double kMaxU32 = 4294967295.0;
constexpr double kMinI32 = -2147483648.0;

// "6065", "0x6065", "1400:5": hexadecimal index, decimal sub-index.
ObjectPlace place_of(const JsonFile& file, const std::string& field, const std::string& given) {
  const std::string text = given.starts_with("0x") || given.starts_with("0X") ? given.substr(2) : given;
  const std::size_t colon = text.find(':');
  const std::string index = text.substr(0, colon);
  const std::string sub = colon == std::string::npos ? "" : text.substr(colon + 1);
  const bool plain = index.size() == 4 && index.find_first_not_of("0123456789ABCDEFabcdef") == std::string::npos &&
                     sub.size() <= 3 && sub.find_first_not_of("0123456789") == std::string::npos &&
                     (colon == std::string::npos) == sub.empty();
  if (!plain) file.fail(field, "\"" + text + "\"; allowed is an object, e.g. \"6065\" or \"1400:5\"");
  ObjectPlace place{static_cast<std::uint16_t>(std::stoul(index, nullptr, 16)), {}};
  if (!sub.empty()) place.sub = static_cast<std::uint8_t>(std::stoul(sub));
  return place;
}

std::vector<ObjectPlace> read_places(const JsonFile& file, const std::string& list) {
  std::vector<ObjectPlace> out;
  for (std::size_t i = 0; file.has(list) && i < file.size(list); ++i)
    out.push_back(place_of(file, at(list, i), file.text(at(list, i))));
  return out;
}

AddedObject read_added(const JsonFile& file, const std::string& field) {
  AddedObject out;
  out.place = place_of(file, field + "/object", file.text(field + "/object"));
  out.type = file.text(field + "/type");
  out.is_read_only = file.text(field + "/access") == "ro";
  out.value = static_cast<std::int64_t>(file.number(field + "/value", kMinI32, kMaxU32));
  if (file.has(field + "/low")) out.low = static_cast<std::int64_t>(file.number(field + "/low", kMinI32, kMaxU32));
  if (file.has(field + "/high")) out.high = static_cast<std::int64_t>(file.number(field + "/high", kMinI32, kMaxU32));
  return out;
}

std::optional<std::uint32_t> read_identity(const JsonFile& file, const std::string& field) {
  if (!file.has(field)) return std::nullopt;
  return static_cast<std::uint32_t>(file.number(field, 0.0, kMaxU32));
}

std::uint64_t read_us(const JsonFile& file, const std::string& field) {
  constexpr double kMost_s = 120.0, kPerSecond = 1e6;
  return file.has(field) ? static_cast<std::uint64_t>(std::llround(kPerSecond * file.number(field, 0.0, kMost_s))) : 0;
}

bool says(const JsonFile& file, const std::string& field, const std::string& word) {
  return file.has(field) && file.text(field) == word;
}

DictionaryConfig read_dictionary(const JsonFile& file, const std::string& type) {
  DictionaryConfig out;
  const std::string own = type + "/dictionary";
  out.absent = read_places(file, own + "/absent");
  out.read_only = read_places(file, own + "/read_only");
  if (file.has(own + "/values"))
    for (const std::string& key : file.keys(own + "/values"))
      out.values[place_of(file, own + "/values/" + key, key)] =
          static_cast<std::int64_t>(file.number(own + "/values/" + key, kMinI32, kMaxU32));
  for (std::size_t i = 0; file.has(own + "/added") && i < file.size(own + "/added"); ++i)
    out.added.push_back(read_added(file, at(own + "/added", i)));
  out.sdo_us = read_us(file, own + "/times/sdo_answer_s");
  out.reset_us = read_us(file, own + "/times/reset_s");
  out.vendor = read_identity(file, type + "/identity/vendor");
  out.product = read_identity(file, type + "/identity/product");
  out.revision = read_identity(file, type + "/identity/revision");
  if (says(file, type + "/units/rated_torque", "uNm")) out.rated_torque_per_mNm = 1000.0;
  out.speeds_in_rpm = says(file, type + "/units/speeds", "rpm");
  return out;
}

}  // namespace

std::map<int, DictionaryConfig> read_dictionaries(const JsonFile& buses) {
  std::map<int, DictionaryConfig> out;
  for (std::size_t i = 0; buses.has("/drives") && i < buses.size("/drives"); ++i) {
    const std::string entry = at("/drives", i);
    const std::string name = buses.text(entry + (buses.has(entry + "/bench") ? "/bench" : "/type"));
    const std::string type = "/drive_types/" + name;
    if (!buses.has(type)) buses.fail(type, "is missing; export the bus table with liana-mission eval");
    DictionaryConfig dictionary = read_dictionary(buses, type);
    dictionary.drive_type = name;
    for (std::size_t k = 0; k < buses.size(entry + "/nodes"); ++k)
      out[buses.integer(at(entry + "/nodes", k), 1, 126)] = dictionary;
  }
  return out;
}

}  // namespace liana::bench
