#include "host/drives/commissioning/eds.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <stdexcept>

namespace liana::commissioning {
namespace {

using Section = std::map<std::string, std::string>;  // keys in lower case
using Sections = std::map<std::string, Section>;     // names in lower case

constexpr std::size_t kMaxRemarks = 20, kMaxSubObjects = 254;
constexpr std::uint16_t kVariable = 7, kArray = 8, kRecord = 9;  // ObjectType
constexpr std::uint16_t kU8 = 5, kU16 = 6, kU32 = 7;             // DataType

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// What a table and a terminal take: other letters, as of Latin-1, become '?'.
std::string printable(std::string_view text) {
  std::string out(text.substr(0, 80));
  for (char& c : out)
    if (c < 0x20 || c > 0x7E || c == '"' || c == '\\') c = '?';
  return out;
}

void remark(Eds& eds, const std::string& text) {
  if (eds.remarks.size() < kMaxRemarks) eds.remarks.push_back(text);
}

Sections sections_of(std::string_view text, Eds& eds) {
  Sections out;
  Section* section = nullptr;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + (text.substr(end).starts_with("\r\n") ? 2 : 1)));
    if (line.empty() || line.front() == ';' || line.front() == '#') continue;
    const std::size_t equals = line.find('=');
    const std::size_t bracket = line.find(']');
    if (line.front() == '[' && bracket != line.npos) {
      section = &out[lower(trimmed(line.substr(1, bracket - 1)))];
    } else if (equals != line.npos && section != nullptr) {
      (*section)[lower(trimmed(line.substr(0, equals)))] = trimmed(line.substr(equals + 1));
    } else {
      remark(eds, "line " + std::to_string(number) + ": '" + printable(line) + "' is neither [section] nor key=value");
    }
  }
  return out;
}

// One number of a value: 0x1F, 31 or, as CiA 306 has it, octal 037.
std::optional<std::int64_t> plain_number(std::string_view text) {
  text = trimmed(text);
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  int base = 10;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    base = 16;
    text.remove_prefix(2);
  } else if (text.size() > 1 && text.front() == '0' && text.find_first_not_of("01234567") == text.npos) {
    base = 8;
  }
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size() || value > 0x7FFFFFFFFFFFFFFF) return std::nullopt;
  const auto number = static_cast<std::int64_t>(value);
  return is_negative ? -number : number;
}

struct Value {
  std::optional<std::int64_t> number;
  bool has_node_id = false;
};

// A number, or a sum of numbers and $NODEID, before a comment.
Value value_of(std::string_view text) {
  text = trimmed(text.substr(0, text.find(';')));
  Value out;
  std::int64_t sum = 0;
  while (!text.empty()) {
    const std::size_t plus = text.find('+', 1);
    const std::string_view part = trimmed(text.substr(0, plus));
    text = plus == text.npos ? std::string_view() : text.substr(plus + 1);
    if (lower(part) == "$nodeid") {
      out.has_node_id = true;
    } else if (const std::optional<std::int64_t> number = plain_number(part)) {
      if (__builtin_add_overflow(sum, *number, &sum)) return {};
    } else {
      return {};
    }
    out.number = sum;
  }
  return out;
}

const std::string* find_key(const Section& section, const char* key) {
  const auto found = section.find(key);
  return found == section.end() ? nullptr : &found->second;
}

std::optional<std::int64_t> number_of(const Section& section, const char* key) {
  const std::string* text = find_key(section, key);
  return text == nullptr ? std::nullopt : value_of(*text).number;
}

std::string text_of(const Section& section, const char* key) {
  const std::string* text = find_key(section, key);
  return text == nullptr ? "" : printable(*text);
}

bool is_number_type(std::uint16_t type) {
  EdsObject object;
  object.data_type = type;
  return object.bytes() != 0;
}

// A negative number of a signed type may stand as its bits, e.g. 0xFD for -3.
std::int64_t in_type(std::int64_t value, const EdsObject& object) {
  const std::size_t bits = 8 * object.bytes();
  const bool is_signed = object.data_type >= 2 && object.data_type <= 4;
  if (!is_signed || bits == 0 || value < (std::int64_t{1} << (bits - 1)) || value >= (std::int64_t{1} << bits))
    return value;
  return value - (std::int64_t{1} << bits);
}

void take_number(const Section& section, const char* key, const std::string& where, EdsObject& object, Eds& eds,
                 std::optional<std::int64_t>& number) {
  const std::string* text = find_key(section, key);
  if (text == nullptr || trimmed(*text).empty()) return;
  const Value value = value_of(*text);
  if (!value.number) return remark(eds, "[" + where + "] " + key + ": '" + printable(*text) + "' is no number");
  number = in_type(*value.number, object);
  object.has_node_id = object.has_node_id || value.has_node_id;
}

EdsObject object_of(const Section& section, const std::string& where, Eds& eds) {
  EdsObject object;
  object.name = text_of(section, "parametername");
  object.data_type = static_cast<std::uint16_t>(number_of(section, "datatype").value_or(0));
  object.access = lower(text_of(section, "accesstype"));
  object.is_mappable = number_of(section, "pdomapping").value_or(0) != 0;
  if (object.data_type != 0 && !is_number_type(object.data_type)) return object;  // texts, domains
  take_number(section, "lowlimit", where, object, eds, object.low);
  take_number(section, "highlimit", where, object, eds, object.high);
  object.has_node_id = false;  // only the value counts
  take_number(section, "defaultvalue", where, object, eds, object.value);
  take_number(section, "parametervalue", where, object, eds, object.value);
  return object;
}

struct ObjectPlace {
  std::uint16_t index = 0;
  std::optional<int> sub;
};

std::optional<int> hex_of(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// "6040", "1018sub1"; nothing for other sections.
std::optional<ObjectPlace> place_of(const std::string& name) {
  const std::size_t at = name.find("sub");
  const std::string_view all = name;
  if ((at == name.npos ? name.size() : at) != 4) return std::nullopt;
  const std::optional<int> index = hex_of(all.substr(0, 4));
  if (!index) return std::nullopt;
  if (at == name.npos) return ObjectPlace{static_cast<std::uint16_t>(*index), {}};
  const std::optional<int> sub = hex_of(all.substr(at + 3));
  if (!sub || *sub < 0 || *sub > 255) return std::nullopt;
  return ObjectPlace{static_cast<std::uint16_t>(*index), *sub};
}

// CompactSubObj: sub-indices 1 to n as the section says, each with its own value of [INDEXValue].
void add_compact(const Sections& sections, const std::string& name, std::uint16_t index, const Section& section,
                 Eds& eds) {
  const auto count = static_cast<std::size_t>(
      std::clamp<std::int64_t>(number_of(section, "compactsubobj").value_or(0), 0, kMaxSubObjects));
  if (count == 0) return;
  EdsObject number;
  number.name = "number of entries";
  number.data_type = kU8;
  number.access = "ro";
  number.value = static_cast<std::int64_t>(count);
  eds.objects[{index, 0}] = number;
  const auto values = sections.find(name + "value");
  for (std::size_t sub = 1; sub <= count; ++sub) {
    EdsObject object = object_of(section, name, eds);
    if (values != sections.end())
      take_number(values->second, std::to_string(sub).c_str(), name + "Value", object, eds, object.value);
    eds.objects[{index, static_cast<std::uint8_t>(sub)}] = object;
  }
}

EdsObject pdo_object(std::uint16_t type, std::int64_t value, bool has_node_id) {
  EdsObject object;
  object.data_type = type;
  object.access = "rw";
  object.value = value;
  object.has_node_id = has_node_id;
  return object;
}

// CompactPDO: the sub-indices of its bits stand in no section, with their values of power-on.
void add_compact_pdos(const Section& device, Eds& eds) {
  const std::int64_t mask = number_of(device, "compactpdo").value_or(0);
  if (mask <= 0 || mask > 0xFF) return;
  for (const auto& [key, page, base] :
       {std::tuple{"nrofrxpdo", 0x1400, 0x200}, std::tuple{"nroftxpdo", 0x1800, 0x180}}) {
    const int count = static_cast<int>(std::clamp<std::int64_t>(number_of(device, key).value_or(0), 0, 32));
    for (int pdo = 0; pdo < count; ++pdo) {
      const auto communication = static_cast<std::uint16_t>(page + pdo);
      for (std::uint8_t sub = 0; sub < 8; ++sub) {
        if (((mask >> sub) & 1) == 0 || eds.objects.contains({communication, sub})) continue;
        const std::uint16_t type = sub == 1 ? kU32 : sub == 3 || sub == 5 ? kU16 : kU8;
        eds.objects[{communication, sub}] = pdo_object(type,
                                                       sub == 1   ? base + 0x100 * pdo
                                                       : sub == 2 ? 255
                                                                  : 0,
                                                       sub == 1);
      }
      for (std::uint8_t sub = 0; sub <= 8; ++sub)
        eds.objects.try_emplace({static_cast<std::uint16_t>(communication + 0x200), sub},
                                pdo_object(sub == 0 ? kU8 : kU32, 0, false));
    }
  }
}

void add_object(const Sections& sections, const std::string& name, const ObjectPlace& place, const Section& section,
                Eds& eds) {
  const std::int64_t type = number_of(section, "objecttype").value_or(kVariable);
  if (place.sub) {
    eds.objects[{place.index, static_cast<std::uint8_t>(*place.sub)}] = object_of(section, name, eds);
  } else if (number_of(section, "compactsubobj").value_or(0) != 0) {
    add_compact(sections, name, place.index, section, eds);
  } else if (type != kArray && type != kRecord) {
    eds.objects[{place.index, 0}] = object_of(section, name, eds);
  } else if (section.contains("datatype") && section.contains("accesstype")) {
    eds.objects.try_emplace({place.index, 0}, object_of(section, name, eds));  // some write sub-index 0 so
  }
}

}  // namespace

std::size_t EdsObject::bytes() const {
  constexpr std::array<std::uint8_t, 8> kPlain{0, 1, 1, 2, 4, 1, 2, 4};  // BOOLEAN to UNSIGNED32
  if (data_type < kPlain.size()) return kPlain[data_type];
  switch (data_type) {
    case 0x08:  // REAL32
      return 4;
    case 0x10:
    case 0x16:
      return 3;
    case 0x11:
    case 0x15:
    case 0x1B:
      return 8;
    default:
      return 0;
  }
}

const EdsObject* Eds::find(std::uint16_t index, std::uint8_t sub) const {
  const auto found = objects.find({index, sub});
  return found == objects.end() ? nullptr : &found->second;
}

Eds parse_eds(std::string_view text, const std::string& file) {
  Eds eds;
  const Sections sections = sections_of(text, eds);
  for (const auto& [name, section] : sections)
    if (const std::optional<ObjectPlace> place = place_of(name)) add_object(sections, name, *place, section, eds);
  static const Section kNone;
  const auto section_named = [&](const char* name) -> const Section& {
    const auto found = sections.find(name);
    return found == sections.end() ? kNone : found->second;
  };
  const Section& device = section_named("deviceinfo");
  const Section& about = section_named("fileinfo");
  add_compact_pdos(device, eds);
  eds.vendor = text_of(device, "vendorname");
  eds.product = text_of(device, "productname");
  eds.vendor_number = number_of(device, "vendornumber");
  eds.version = text_of(about, "fileversion") + "." + text_of(about, "filerevision");
  if (eds.find(0x1000, 0) == nullptr && eds.find(0x1018, 1) == nullptr)
    throw std::runtime_error(file + ": " + std::to_string(eds.objects.size()) +
                             " objects, none of them 1000 or 1018:1: allowed is the EDS or DCF of a CANopen device "
                             "(CiA 306), a text with sections as [1000]: take the file of the drive's maker");
  return eds;
}

}  // namespace liana::commissioning
