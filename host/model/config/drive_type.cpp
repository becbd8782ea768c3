#include "host/model/config/drive_type.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "host/model/config/field.hpp"

namespace liana::config {
namespace {

constexpr std::int64_t kMaxU32 = 0xFFFFFFFF;

std::uint32_t read_u32(const Field& field) { return static_cast<std::uint32_t>(field.integer(0, kMaxU32)); }

template <typename Value, typename Read>
void read_if_there(const Field& table, const char* key, Value& value, const Read& read) {
  if (table.json().contains(key)) value = read(table.at(key));
}

std::string read_text(const Field& field, std::size_t longest) {
  const std::string allowed = "a text of 1 to " + std::to_string(longest) + " bytes";
  if (!field.json().is_string() || field.json().text().empty() || field.json().text().size() > longest)
    field.refuse(allowed, "say it shorter, and not with nothing");
  return field.json().text();
}

bool read_truth(const Field& field) {
  if (!field.json().is_boolean()) field.refuse("true or false", "use one of these words");
  return field.json().get<bool>();
}

std::optional<Factor> read_factor(const Field& field) {
  field.size(2, 2, "give two whole numbers, as sub-index 1 and 2 have them");
  const auto part = [&](std::size_t i) { return static_cast<std::uint32_t>(field.element(i).integer(1, kMaxU32)); };
  return Factor{part(0), part(1)};
}

// What csp is made of: its targets and reports, its mode, and that the drive says it has it.
bool makes_csp(ObjectId object) {
  constexpr std::array<std::uint16_t, 6> kMade{0x6040, 0x6041, 0x6060, 0x6064, 0x607A, 0x6502};
  return object.sub == 0 && std::find(kMade.begin(), kMade.end(), object.index) != kMade.end();
}

// An object of the boot's; objects that it never touches have no rule.
ObjectId read_ruled(const Field& field, const std::string& text) {
  const ObjectId object = parse_object(field, text);
  if (generic_rules().contains(object)) return object;
  std::string known;
  for (const auto& [each, presence] : generic_rules()) known += (known.empty() ? "" : ", ") + object_name(each);
  field.refuse("the objects of the boot (" + known + ")", "use writes for objects that only this maker has");
}

// Without these there is nothing to boot.
void refuse_what_is_needed(const Field& field, Presence presence) {
  if (presence == Presence::kRequired) return;
  const ObjectId object = parse_object(field, field.json().text());
  if (makes_csp(object))
    field.refuse("any object but 6040, 6041, 6060, 6064, 607A and 6502, which make csp",
                 "take it off the list: a drive without it cannot be driven (docs/reference/drives.md)");
  if (presence == Presence::kAbsent && (object == ObjectId{0x1400, 1} || object == ObjectId{0x1800, 1}))
    field.refuse("any object but 1400:1 and 1800:1", "without process data a drive cannot be driven");
}

// A fixed mode has to be the one that is driven.
void refuse_another_mode(const Field& field, ObjectId object, std::uint32_t value, bool is_cst) {
  if (object.index == 0x6060 && is_cst && value != 10)
    field.refuse("10, which is cst", "take it off the list, or say mode = \"csp\"");
  if (object.index == 0x6060 && !is_cst && value != 8) field.refuse("8, which is csp", "no other mode is driven");
  if (object.index == 0x6502 && is_cst && (value & 0x200) == 0)
    field.refuse("numbers with bit 9 (512), which is cst", "a drive without cst cannot be driven so");
  if (object.index == 0x6502 && !is_cst && (value & 0x80) == 0)
    field.refuse("numbers with bit 7 (128), which is csp", "a drive without csp cannot be driven");
}

void read_list(const Field& lists, const char* key, Presence presence, DriveType& out) {
  if (!lists.json().contains(key)) return;
  const Field list = lists.at(key);
  const std::size_t count = list.size(0, generic_rules().size(), "name each object once");
  for (std::size_t i = 0; i < count; ++i) {
    const Field field = list.element(i);
    if (!field.json().is_string()) field.refuse("an object as text, e.g. \"6065\" or \"1400:5\"", "put it in quotes");
    refuse_what_is_needed(field, presence);
    const ObjectId object = read_ruled(field, field.json().text());
    if (!out.objects.emplace(object, ObjectRule{presence, {}}).second)
      field.refuse("each object once", "decide what it is");
  }
}

void read_objects(const Field& table, DriveType& out) {
  table.only({"required", "optional", "absent", "fixed"});
  read_list(table, "required", Presence::kRequired, out);
  read_list(table, "optional", Presence::kOptional, out);
  read_list(table, "absent", Presence::kAbsent, out);
  if (!table.json().contains("fixed")) return;
  const Field fixed = table.at("fixed");
  if (!fixed.json().is_object()) fixed.refuse("a table { [\"6066\"] = 0, ... }", "give each fixed object its value");
  for (const auto& [key, value] : fixed.json().items()) {
    const Field field(value, fixed.file(), "objects.fixed." + key);
    const ObjectRule rule{Presence::kFixed, read_u32(field)};
    const ObjectId object = read_ruled(field, key);
    refuse_another_mode(field, object, *rule.value, out.is_cst);
    if (!out.objects.emplace(object, rule).second) field.refuse("each object once", "decide what it is");
  }
}

void read_units(const Field& table, DriveUnits& out) {
  table.only({"position", "velocity", "speeds", "rated_torque", "encoder", "gear", "feed"});
  read_if_there(table, "position", out.position, read_u32);
  read_if_there(table, "velocity", out.velocity, read_u32);
  read_if_there(table, "speeds", out.speeds_in_rpm, [](const Field& field) {
    return field.choice({"increments", "rpm"}) == "rpm";
  });
  read_if_there(table, "rated_torque", out.rated_torque_per_Nm, [](const Field& field) {
    return field.choice({"mNm", "uNm"}) == "uNm" ? 1e6 : 1e3;
  });
  read_if_there(table, "encoder", out.encoder, read_factor);
  read_if_there(table, "gear", out.gear, read_factor);
  read_if_there(table, "feed", out.feed, read_factor);
}

void read_stop(const Field& table, DriveType& out) {
  table.only({"within_s", "quick_stop_option", "fault_option", "abort_connection_option"});
  const auto option = [](const Field& field) { return static_cast<std::int16_t>(field.integer(-32768, 32767)); };
  read_if_there(table, "within_s", out.stop_within_s, [](const Field& field) { return field.number({0.001, 10.0}); });
  read_if_there(table, "quick_stop_option", out.quick_stop_option, option);
  read_if_there(table, "fault_option", out.fault_option, option);
  read_if_there(table, "abort_connection_option", out.abort_connection_option, option);
}

StartUpWrite read_write(const Field& field) {
  field.only({"object", "name", "bits", "value", "read_back"});
  StartUpWrite out;
  const Field object = field.at("object");
  if (!object.json().is_string()) object.refuse("an object as text, e.g. \"3001:2\"", "put it in quotes");
  out.object = parse_object(object, object.json().text());
  if (generic_rules().contains(out.object))
    object.refuse("objects that the boot does not write itself",
                  "use the fields that docs/reference/drives.md has for it");
  if (out.object.index == 0x6040)
    object.refuse("any object but 6040", "it switches torque, and only the controller does that");
  out.name = read_text(field.at("name"), 60);
  const std::int64_t bits = field.at("bits").integer(8, 32);
  if (bits != 8 && bits != 16 && bits != 32) field.at("bits").refuse("8, 16 or 32", "take the object's own size");
  out.bytes = static_cast<std::uint8_t>(bits / 8);
  const std::int64_t most = (std::int64_t{1} << bits) - 1;
  out.value = static_cast<std::uint32_t>(field.at("value").integer(-(most / 2) - 1, most) & most);
  read_if_there(field, "read_back", out.read_back, read_truth);
  return out;
}

void read_times(const Field& table, DriveTimes& out) {
  table.only({"sdo_answer_s", "boot_up_s", "operational_s"});
  const auto seconds = [](const Field& field) { return field.number({0.05, 120.0}); };
  read_if_there(table, "sdo_answer_s", out.sdo_answer_s, seconds);
  read_if_there(table, "boot_up_s", out.boot_up_s, seconds);
  read_if_there(table, "operational_s", out.operational_s, seconds);
}

void check_objects(const Field& dictionary, const char* key) {
  if (!dictionary.json().contains(key)) return;
  const Field list = dictionary.at(key);
  const std::size_t count = list.size(0, 200, "name each object once");
  for (std::size_t i = 0; i < count; ++i) {
    if (!list.element(i).json().is_string()) list.element(i).refuse("an object as text", "put it in quotes");
    parse_object(list.element(i), list.element(i).json().text());
  }
}

void check_added(const Field& field) {
  field.only({"object", "type", "access", "value", "low", "high"});
  parse_object(field.at("object"), read_text(field.at("object"), 8));
  field.at("type").choice({"u8", "i8", "u16", "i16", "u32", "i32"});
  field.at("access").choice({"ro", "rw"});
  for (const char* key : {"value", "low", "high"})
    if (key == std::string("value") || field.json().contains(key)) field.at(key).integer(-0x80000000LL, kMaxU32);
}

// What the bench's drives of the type have; the bench reads it itself.
void check_dictionary(const Field& table) {
  table.only({"absent", "read_only", "values", "added", "times"});
  check_objects(table, "absent");
  check_objects(table, "read_only");
  if (table.json().contains("values")) {
    const Field values = table.at("values");
    if (!values.json().is_object()) values.refuse("a table { [\"6066\"] = 0, ... }", "give each object its value");
    for (const auto& [key, value] : values.json().items()) {
      const Field field(value, table.file(), "dictionary.values." + key);
      parse_object(field, key);
      field.integer(-0x80000000LL, kMaxU32);
    }
  }
  if (table.json().contains("times")) {
    const Field times = table.at("times");
    times.only({"sdo_answer_s", "reset_s"});
    for (const char* key : {"sdo_answer_s", "reset_s"})
      if (times.json().contains(key)) times.at(key).number({0.0, 120.0});
  }
  if (!table.json().contains("added")) return;
  const Field added = table.at("added");
  const std::size_t count = added.size(0, 100, "a dictionary has at most 100 objects more");
  for (std::size_t i = 0; i < count; ++i) check_added(added.element(i));
}

void read_identity_of(const Field& table, DriveType& out) {
  table.only({"vendor", "product", "revision"});
  read_if_there(table, "vendor", out.vendor, read_u32);
  read_if_there(table, "product", out.product, read_u32);
  read_if_there(table, "revision", out.revision, read_u32);
}

}  // namespace

const std::map<ObjectId, Presence>& generic_rules() {
  using enum Presence;
  static const std::map<ObjectId, Presence> rules = {
      {{0x1000, 0}, kRequired}, {{0x1016, 1}, kRequired}, {{0x1017, 0}, kRequired}, {{0x1018, 1}, kRequired},
      {{0x1018, 2}, kRequired}, {{0x1018, 3}, kRequired}, {{0x1018, 4}, kOptional}, {{0x1400, 1}, kRequired},
      {{0x1400, 2}, kRequired}, {{0x1400, 5}, kOptional}, {{0x1800, 1}, kRequired}, {{0x1800, 2}, kRequired},
      {{0x6007, 0}, kOptional}, {{0x605A, 0}, kOptional}, {{0x605E, 0}, kOptional}, {{0x6060, 0}, kRequired},
      {{0x6061, 0}, kOptional}, {{0x6065, 0}, kOptional}, {{0x6066, 0}, kOptional}, {{0x6072, 0}, kOptional},
      {{0x6076, 0}, kOptional}, {{0x607D, 1}, kOptional}, {{0x607D, 2}, kOptional}, {{0x607E, 0}, kOptional},
      {{0x607F, 0}, kOptional}, {{0x6080, 0}, kOptional}, {{0x6085, 0}, kOptional}, {{0x608F, 1}, kOptional},
      {{0x608F, 2}, kOptional}, {{0x6091, 1}, kOptional}, {{0x6091, 2}, kOptional}, {{0x6092, 1}, kOptional},
      {{0x6092, 2}, kOptional}, {{0x60A8, 0}, kOptional}, {{0x60A9, 0}, kOptional}, {{0x60C2, 1}, kRequired},
      {{0x60C2, 2}, kRequired}, {{0x60C5, 0}, kOptional}, {{0x6502, 0}, kRequired}};
  return rules;
}

ObjectRule DriveType::rule_of(ObjectId object) const {
  if (const auto own = objects.find(object); own != objects.end()) return own->second;
  const auto generic = generic_rules().find(object);
  return {generic == generic_rules().end() ? Presence::kRequired : generic->second, {}};
}

bool DriveType::stops_by_itself() const {
  const auto is_sure = [&](ObjectId object) {
    const ObjectRule rule = rule_of(object);
    return rule.presence == Presence::kRequired || rule.value.value_or(0) != 0;
  };
  const std::uint32_t reaction =
      rule_of({0x6007, 0}).value.value_or(static_cast<std::uint32_t>(abort_connection_option));
  return (is_sure({0x1016, 1}) || is_sure({0x1400, 5})) && reaction != 0;
}

ObjectId parse_object(const Field& field, const std::string& given) {
  const std::string allowed = "an object as index, or index:sub-index, e.g. \"6065\" or \"1400:5\"";
  const std::string text = given.starts_with("0x") || given.starts_with("0X") ? given.substr(2) : given;
  const std::size_t colon = text.find(':');
  const std::string index = text.substr(0, colon);
  const std::string sub = colon == text.npos ? "0" : text.substr(colon + 1);
  const bool plain = index.size() == 4 && index.find_first_not_of("0123456789ABCDEFabcdef") == index.npos &&
                     !sub.empty() && sub.size() <= 3 && sub.find_first_not_of("0123456789") == sub.npos;
  if (!plain || std::stoul(sub) > 255)
    field.refuse(allowed, "the index is hexadecimal, 0 to FFFF, the sub-index decimal, 0 to 255");
  return {static_cast<std::uint16_t>(std::stoul(index, nullptr, 16)), static_cast<std::uint8_t>(std::stoul(sub))};
}

std::string object_name(ObjectId object) {
  char index[8];
  std::snprintf(index, sizeof index, "%04X", object.index);
  return object.sub == 0 ? index : index + (":" + std::to_string(object.sub));
}

namespace {

// The page that has the fields of drive types, in place of the one that has those of other tables, or behind the rest.
std::string with_guide(std::string text) {
  const std::string page = "docs/reference/drives.md", other = "docs/reference/formats.md";
  if (const std::size_t at = text.find(other); at != text.npos) return text.replace(at, other.size(), page);
  return text.find(page) != text.npos ? text : text + "; see " + page;
}

DriveType read_drive_type(const Json& json, const std::string& file) {
  const Field table(json, file, "");
  check_kind(table, "drive");
  table.only({"format", "kind", "name", "source", "identity", "objects", "units", "polarity", "max_torque_permille",
              "following_time_ms", "stop", "mapping", "times", "writes", "dictionary", "mode", "torque"});
  DriveType out;
  out.name = table.at("name").name(40);
  out.source = read_text(table.at("source"), 400);
  if (json.contains("identity")) read_identity_of(table.at("identity"), out);
  read_if_there(table, "mode", out.is_cst, [](const Field& field) { return field.choice({"csp", "cst"}) == "cst"; });
  if (json.contains("objects")) read_objects(table.at("objects"), out);
  if (json.contains("units")) read_units(table.at("units"), out.units);
  read_if_there(table, "polarity", out.polarity, [](const Field& field) {
    const std::int64_t value = field.integer(0, 255);
    if ((value & ~std::int64_t{0xC0}) != 0) field.refuse("0, 64, 128 or 192", "only bits 7 and 6 have a meaning");
    return static_cast<std::uint32_t>(value);
  });
  const auto u16 = [](const Field& field) { return static_cast<std::uint16_t>(field.integer(0, 65535)); };
  read_if_there(table, "max_torque_permille", out.max_torque_permille, u16);
  read_if_there(table, "following_time_ms", out.following_time_ms, u16);
  if (json.contains("stop")) read_stop(table.at("stop"), out);
  read_if_there(table, "mapping", out.mapping_is_fixed, [](const Field& field) {
    return field.choice({"written", "fixed"}) == "fixed";
  });
  read_if_there(table, "torque", out.has_torque, [](const Field& field) {
    return field.choice({"6077", "none"}) == "6077";
  });
  if (!out.has_torque && out.is_cst)
    table.at("torque").refuse("\"6077\" with mode = \"cst\"", "a drive that follows torques has to report them");
  if (json.contains("times")) read_times(table.at("times"), out.times);
  if (json.contains("dictionary")) check_dictionary(table.at("dictionary"));
  if (!json.contains("writes")) return out;
  const Field writes = table.at("writes");
  const std::size_t count = writes.size(0, 16, "a type has at most 16 start-up writes");
  for (std::size_t i = 0; i < count; ++i) out.writes.push_back(read_write(writes.element(i)));
  return out;
}

}  // namespace

DriveType parse_drive_type(const Json& json, const std::string& file) {
  try {
    return read_drive_type(json, file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(with_guide(error.what()));
  }
}

}  // namespace liana::config
