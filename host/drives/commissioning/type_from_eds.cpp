#include "host/drives/commissioning/type_from_eds.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <set>

#include "host/drives/canopen/boot_plan.hpp"

namespace liana::commissioning {
namespace {

using config::ObjectId;
using config::Presence;

constexpr std::uint32_t kIncrements = 0x00B50000;  // 60A8
constexpr std::uint32_t kRpm = 0x00B44700;         // 60A9
constexpr std::uint32_t kIncrementsPerSecond = 0x00B50300;
constexpr std::uint16_t kPeriod = 0x60C2;
constexpr ObjectId kPositionUnit{0x60A8, 0}, kVelocityUnit{0x60A9, 0}, kTorque{0x6077, 0}, kMaxTorque{0x6072, 0};
constexpr std::array<ObjectId, 3> kSpeeds{ObjectId{0x607F, 0}, ObjectId{0x60C5, 0}, ObjectId{0x6085, 0}};

// Of the boot's objects: those that the bench's drive has, and those that a table adds to it.
constexpr std::array<ObjectId, 20> kOfBench{
    ObjectId{0x1016, 1}, ObjectId{0x1400, 5}, ObjectId{0x6007, 0}, ObjectId{0x605A, 0}, ObjectId{0x605E, 0},
    ObjectId{0x6061, 0}, ObjectId{0x6065, 0}, ObjectId{0x6066, 0}, ObjectId{0x6072, 0}, ObjectId{0x6076, 0},
    ObjectId{0x6077, 0}, ObjectId{0x6078, 0}, ObjectId{0x6085, 0}, ObjectId{0x608F, 1}, ObjectId{0x608F, 2},
    ObjectId{0x6091, 1}, ObjectId{0x6091, 2}, ObjectId{0x60C2, 1}, ObjectId{0x60C2, 2}, ObjectId{0x60F4, 0}};
constexpr std::array<ObjectId, 10> kAddedToBench{
    ObjectId{0x607D, 1}, ObjectId{0x607D, 2}, ObjectId{0x607E, 0}, ObjectId{0x607F, 0}, ObjectId{0x6080, 0},
    ObjectId{0x6092, 1}, ObjectId{0x6092, 2}, ObjectId{0x60A8, 0}, ObjectId{0x60A9, 0}, ObjectId{0x60C5, 0}};

std::string hex(std::int64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%llX", static_cast<unsigned long long>(value) & 0xFFFFFFFF);
  return text;
}

std::string quoted(ObjectId object) { return "\"" + config::object_name(object) + "\""; }

// What a boot of a drive that has everything does to its objects, in its order.
struct Needs {
  std::vector<canopen::BootObject> objects;
  explicit Needs(bool is_cst) {
    canopen::ExpectedDrive drive;
    drive.node = 1;
    drive.type.is_cst = is_cst;
    drive.period = {4, -3};
    const canopen::BootPlan plan(std::span(&drive, 1));
    objects.assign(plan.objects().begin(), plan.objects().end());
  }
};

class Maker {
 public:
  Maker(const Eds& eds, bool is_cst) : eds_(eds), is_cst_(is_cst), needs_(is_cst) {}

  TypeFromEds make(const std::string& source) {
    out_.name = name();
    check_profile();
    check_modes();
    check_units();
    for (const canopen::BootObject& object : needs_.objects) look_at(object);
    check_mapping();
    check_axes();
    tell_what_is_not_checked();
    for (const std::string& remark : eds_.remarks) note("not understood: " + remark);
    if (out_.missing.empty()) out_.table = table(source);
    return std::move(out_);
  }

 private:
  void note(const std::string& text) { out_.notes.push_back(text); }
  void lacks(const std::string& text) { out_.missing.push_back(text); }
  const EdsObject* find(ObjectId object) const { return eds_.find(object.index, object.sub); }
  const char* mode() const { return is_cst_ ? "cst" : "csp"; }

  std::string name() const {
    std::string text = eds_.product.empty() ? eds_.vendor : eds_.product;
    std::string name;
    for (const char c : text) {
      const auto letter = static_cast<unsigned char>(c);
      if (std::isalnum(letter) != 0) {
        name += static_cast<char>(std::tolower(letter));
      } else if (!name.empty() && name.back() != '_') {
        name += '_';
      }
    }
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name.empty() ? "my_drive" : name.substr(0, 40);
  }

  void check_profile() {
    const EdsObject* type = find({0x1000, 0});
    if (type == nullptr || type->value.value_or(0) == 0 || (*type->value & 0xFFFF) == 402) return;
    lacks("1000 (device type) is " + hex(*type->value) + ", of profile " + std::to_string(*type->value & 0xFFFF) +
          ": a drive has profile 402");
  }

  void check_modes() {
    const EdsObject* modes = find({0x6502, 0});
    const std::int64_t bit = is_cst_ ? 0x200 : 0x80;
    if (modes == nullptr) return;  // look_at() says so
    if (!modes->value || *modes->value == 0)
      note("6502 (supported drive modes) has no value in the file: liana drive check reads whether the drive has " +
           std::string(mode()));
    else if ((*modes->value & bit) == 0)
      lacks("6502 (supported drive modes) is " + hex(*modes->value) + ", without bit " + (is_cst_ ? "9" : "7") +
            ": the drive has no " + mode());
  }

  void check_units() {
    if (const EdsObject* unit = find(kPositionUnit); unit != nullptr && unit->value) {
      const auto value = static_cast<std::uint32_t>(*unit->value);
      if (value != kIncrements && value != 0 && !unit->is_writable())
        lacks("60A8 (unit of positions) is " + hex(value) + " and cannot be written: Liana needs increments, " +
              hex(kIncrements));
    }
    const EdsObject* unit = find(kVelocityUnit);
    if (unit == nullptr || !unit->value || *unit->value == 0) {
      note("60A9 (unit of speeds) says nothing: 607F, 60C5 and 6085 are taken for increments/s and increments/s^2");
      return;
    }
    velocity_ = static_cast<std::uint32_t>(*unit->value);
    if (*velocity_ == kRpm || *velocity_ == kIncrementsPerSecond) return;
    note("60A9 (unit of speeds) is " + hex(*velocity_) +
         ", neither rpm nor increments/s: 607F, 60C5 and 6085 are left out and nobody checks them");
    for (const ObjectId speed : kSpeeds) left_out_.insert(speed);
  }

  // One object of the boot: absent, fixed, or as the boot needs it.
  void look_at(const canopen::BootObject& needed) {
    const ObjectId id{needed.index, needed.sub};
    const bool is_pdo = (needed.index >= 0x1400 && needed.index < 0x1C00);
    const bool is_ruled = config::generic_rules().contains(id);
    if (is_pdo && !is_ruled) return;  // check_mapping()
    if (!is_ruled || !seen_.insert(id).second) return;
    const EdsObject* object = find(id);
    if (object == nullptr || left_out_.contains(id)) return absent(needed, id);
    if (needed.write && object->bytes() != 0 && object->bytes() != needed.bytes && !is_pdo)
      return lacks(text_of(needed) + " has " + std::to_string(8 * object->bytes()) + " bits, and a boot writes " +
                   std::to_string(8 * needed.bytes));
    if (needed.write && !object->is_writable()) constant(needed, id, *object);
  }

  std::string text_of(const canopen::BootObject& object) const {
    return config::object_name({object.index, object.sub}) + " (" + object.name + ")";
  }

  void absent(const canopen::BootObject& needed, ObjectId id) {
    const bool is_optional = config::generic_rules().at(id) == Presence::kOptional;
    const bool is_droppable =
        is_optional || id == ObjectId{0x1016, 1} || id.index == kPeriod || (id.index == 0x1018 && id.sub > 1);
    if (!is_droppable) return lacks(text_of(needed) + " is not in the file, and " + mode() + " needs it");
    absent_.push_back(id);
  }

  void constant(const canopen::BootObject& needed, ObjectId id, const EdsObject& object) {
    if (id == ObjectId{0x1400, 2} || id == ObjectId{0x1800, 2}) {
      const bool is_right = id.index == 0x1400 ? object.value.has_value() : object.value == 1;
      if (!is_right)
        lacks(text_of(needed) + " cannot be written and is " +
              (object.value ? std::to_string(*object.value) : "not said") + ": it has to be 1, every SYNC");
      return;
    }
    if (id.sub == 1 && (id.index == 0x1400 || id.index == 0x1800)) {
      const std::int64_t usual = (id.index == 0x1400 ? 0x200 : 0x180) + (object.has_node_id ? 0 : 1);
      if (!object.has_node_id || (object.value.value_or(0) & 0x7FF) != usual)
        lacks(text_of(needed) + " cannot be written and is not " + hex(usual) + " + node id");
      else
        note(text_of(needed) + " cannot be written: the PDO cannot be disabled while it is mapped");
      return;
    }
    if (!object.value)
      return note(text_of(needed) + " cannot be written, and the file has no value for it: put it under objects.fixed");
    if (id == ObjectId{0x6060, 0} && *object.value != (is_cst_ ? 10 : 8))
      return lacks("6060 (mode of operation) cannot be written and is " + std::to_string(*object.value));
    if (id == ObjectId{0x1017, 0} || id == ObjectId{0x60C2, 1} || id == kPositionUnit)
      note(text_of(needed) + " cannot be written: it stays " + std::to_string(*object.value));
    const std::uint32_t mask = canopen::all_bits(needed.bytes);
    fixed_.push_back({id, static_cast<std::uint32_t>(*object.value) & mask});
  }

  // The objects of the process data, and whether the mapping can be made of them.
  void check_mapping() {
    std::set<std::uint16_t> judged;
    for (const canopen::BootObject& entry : needs_.objects) {
      if (!canopen::is_mapping_entry(entry.index, entry.sub)) continue;
      const ObjectId mapped = canopen::mapped_object(entry.value);
      const EdsObject* object = find(mapped);
      if (mapped == kTorque && object == nullptr) {
        has_torque_ = false;
        continue;
      }
      if (object == nullptr) {
        lacks(config::object_name(mapped) + " is not in the file, and " + text_of(entry) + " has to map it");
      } else if (object->bytes() != 0 && object->bytes() * 8 != (entry.value & 0xFF)) {
        lacks(config::object_name(mapped) + " has " + std::to_string(8 * object->bytes()) + " bits, and " +
              text_of(entry) + " maps " + std::to_string(entry.value & 0xFF));
      } else if (!object->is_mappable) {
        note(config::object_name(mapped) + " is not marked as one that can be mapped (PDOMapping=1)");
      }
    }
    for (const canopen::BootObject& entry : needs_.objects)
      if (canopen::is_mapping_entry(entry.index, entry.sub) && judged.insert(entry.index).second)
        judge_mapping(entry.index);
    if (!has_torque_)
      note(
          "6077 (torque) is not in the file: the type says torque = \"none\"; tension is by load cells where the bus "
          "table has them, else nothing watches it (docs/reference/drives.md)");
    if (is_fixed_ && is_writable_mapping_)
      note("only some of the mappings can be written: the type takes all as they are in the drive");
  }

  std::vector<std::uint32_t> wanted_entries(std::uint16_t mapping) const {
    std::vector<std::uint32_t> entries;
    for (const canopen::BootObject& each : needs_.objects)
      if (each.index == mapping && each.sub != 0 && (has_torque_ || each.value >> 16 != kTorque.index))
        entries.push_back(each.value);
    return entries;
  }

  void judge_mapping(std::uint16_t mapping) {
    const EdsObject* count = eds_.find(mapping, 0);
    const std::string where = config::object_name({mapping, 0});
    if (count == nullptr) return lacks(where + " (mapping) is not in the file: without process data nothing is driven");
    const std::vector<std::uint32_t> wanted = wanted_entries(mapping);
    bool is_writable = count->is_writable(), is_equal = count->value == static_cast<std::int64_t>(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const EdsObject* entry = eds_.find(mapping, static_cast<std::uint8_t>(i + 1));
      is_writable = is_writable && entry != nullptr && entry->is_writable();
      is_equal = is_equal && entry != nullptr && entry->value == static_cast<std::int64_t>(wanted[i]);
    }
    (is_writable ? is_writable_mapping_ : is_fixed_) = true;
    if (is_writable || is_equal) return;
    std::string has;
    for (std::uint8_t sub = 1; sub <= 8; ++sub)
      if (const EdsObject* entry = eds_.find(mapping, sub); entry != nullptr && entry->value.value_or(0) != 0)
        has += (has.empty() ? "" : " ") + hex(*entry->value);
    std::string needs;
    for (const std::uint32_t entry : wanted) needs += (needs.empty() ? "" : " ") + hex(entry);
    lacks(where + " (mapping) cannot be written so: it has " + (has.empty() ? "nothing" : has) + ", and needs " +
          needs);
  }

  void check_axes() {
    if (eds_.find(0x6840, 0) != nullptr) note("the drive has a second axis (6840): the table is that of its first");
  }

  void tell_what_is_not_checked() {
    const auto has = [&](ObjectId id) { return std::find(absent_.begin(), absent_.end(), id) == absent_.end(); };
    if (!has({0x1018, 2})) note("1018:2 (product code) is not in the file: nobody checks which product it is");
    if (!has({kPeriod, 1}))
      note("60C2 (interpolation period) is not in the file: the drive has to take one target a SYNC by itself");
    if (!has({0x608F, 1})) note("608F (encoder) is not in the file: nobody checks the robot's counts_per_turn");
    if (!has({0x6091, 1})) note("6091 (gear) is not in the file: nobody checks the robot's gear");
    if (!has({0x6076, 0})) note("6076 (rated torque) is not in the file: nobody checks the robot's rated_torque_Nm");
    if (!has(kMaxTorque)) note("6072 (max torque) is not in the file: the drive does not limit its torque by it");
    if (!has({0x6061, 0}))
      note("6061 (mode display) is not in the file: that the drive stays in its mode is not watched");
    if (!has({0x1016, 1}) && !has({0x1400, 5}))
      note("neither 1016:1 nor 1400:5 is in the file: nothing stops the drive when its master is lost");
  }

  std::string identity() const {
    const auto number = [&](std::uint8_t sub) {
      const EdsObject* object = eds_.find(0x1018, sub);
      return object == nullptr ? std::int64_t{0} : object->value.value_or(0);
    };
    const std::int64_t vendor = number(1) != 0 ? number(1) : eds_.vendor_number.value_or(0);
    std::string out;
    if (vendor != 0) out += "vendor = " + hex(vendor);
    if (number(2) != 0) out += (out.empty() ? "" : ", ") + ("product = " + hex(number(2)));
    std::string text = out.empty() ? "" : "  identity = { " + out + " },\n";
    if (number(3) != 0)
      text += "  -- revision in the file: " + hex(number(3)) + "; the robot table says which one is meant\n";
    return text;
  }

  static void add_list(std::string& text, const char* key, const std::vector<ObjectId>& objects) {
    if (objects.empty()) return;
    text += std::string("    ") + key + " = {";
    std::size_t column = 20;
    for (const ObjectId object : objects) {
      const std::string next = " " + quoted(object) + ",";
      if (column + next.size() > 110) {
        text += "\n      ";
        column = 6;
      }
      text += next;
      column += next.size();
    }
    text.pop_back();
    text += " },\n";
  }

  std::string table(const std::string& source) const {
    std::string text = "-- Made by liana drive type from " + source + ". Begin with liana drive check.\n";
    for (const std::string& each : out_.notes) text += "-- Note: " + each + ".\n";
    text += "return {\n  format = 1, kind = \"drive\", name = \"" + out_.name + "\",\n  source = \"" +
            (eds_.vendor + ", " + eds_.product).substr(0, 180) + ", " + source + ", file version " +
            eds_.version.substr(0, 40) + "\",\n";
    if (is_cst_) text += "  mode = \"cst\",\n";
    text += identity();
    if (!absent_.empty() || !fixed_.empty()) {
      text += "  objects = {\n";
      add_list(text, "absent", absent_);
      if (!fixed_.empty()) {
        text += "    fixed = {";
        for (const auto& [id, value] : fixed_) text += " [" + quoted(id) + "] = " + std::to_string(value) + ",";
        text.pop_back();
        text += " },\n";
      }
      text += "  },\n";
    }
    std::string units;
    if (velocity_) units += " velocity = " + hex(*velocity_) + ",";
    if (velocity_ == kRpm) units += " speeds = \"rpm\",";
    if (!units.empty()) text += "  units = {" + units.substr(0, units.size() - 1) + " },\n";
    if (const EdsObject* polarity = eds_.find(0x607E, 0);
        polarity != nullptr && (polarity->value.value_or(0) & 0xC0) != 0)
      text += "  polarity = " + std::to_string(*polarity->value & 0xC0) + ",\n";
    if (const EdsObject* most = find(kMaxTorque);
        most != nullptr && most->high && *most->high > 0 && *most->high < 1000)
      text += "  max_torque_permille = " + std::to_string(*most->high) + ",\n";
    if (!has_torque_) text += "  torque = \"none\",\n";
    if (is_fixed_) text += "  mapping = \"fixed\",\n";
    return text + bench_dictionary() + "}\n";
  }

  // What the bench's drive of the type is: it lacks what this one lacks, and has what the boot asks for besides.
  std::string bench_dictionary() const {
    std::vector<ObjectId> lacking, constant;
    std::string values, added;
    for (const ObjectId id : kOfBench)
      if (find(id) == nullptr) lacking.push_back(id);
    const auto give = [&](ObjectId id, std::int64_t value) {
      values += " [" + quoted(id) + "] = " + std::to_string(value) + ",";
    };
    for (const auto& [id, value] : fixed_) {
      if (!in(kAddedToBench, id)) constant.push_back(id);
      if (in(kOfBench, id) || id == ObjectId{0x6060, 0}) give(id, *find(id)->value);
    }
    for (const std::uint16_t mapping : {std::uint16_t{0x1600}, std::uint16_t{0x1A00}}) {
      const std::vector<std::uint32_t> entries = wanted_entries(mapping);
      for (std::size_t sub = 0; is_fixed_ && sub <= entries.size(); ++sub) {
        const ObjectId id{mapping, static_cast<std::uint8_t>(sub)};
        constant.push_back(id);
        give(id, static_cast<std::int64_t>(sub == 0 ? entries.size() : entries[sub - 1]));
      }
    }
    for (const ObjectId id : kAddedToBench) {
      const EdsObject* object = find(id);
      if (object == nullptr || object->bytes() == 0 || object->bytes() > 4) continue;
      const bool is_signed = object->data_type >= 2 && object->data_type <= 4;
      added += "      { object = " + quoted(id) + ", type = \"" + (is_signed ? "i" : "u") +
               std::to_string(8 * object->bytes()) + "\", access = \"" + (object->is_writable() ? "rw" : "ro") +
               "\", value = " + std::to_string(object->value.value_or(0)) + " },\n";
    }
    std::string text;
    add_list(text, "absent", lacking);
    add_list(text, "read_only", constant);
    if (!values.empty()) text += "    values = {" + values.substr(0, values.size() - 1) + " },\n";
    if (!added.empty()) text += "    added = {\n" + added + "    },\n";
    return text.empty() ? "" : "  dictionary = { -- of the bench's drive\n" + text + "  },\n";
  }

  template <std::size_t N>
  static bool in(const std::array<ObjectId, N>& all, ObjectId id) {
    return std::find(all.begin(), all.end(), id) != all.end();
  }

  struct Fixed {
    ObjectId id;
    std::uint32_t value;
  };

  const Eds& eds_;
  bool is_cst_;
  Needs needs_;
  TypeFromEds out_;
  std::set<ObjectId> seen_, left_out_;
  std::vector<ObjectId> absent_;
  std::vector<Fixed> fixed_;
  std::optional<std::uint32_t> velocity_;
  bool has_torque_ = true;
  bool is_fixed_ = false, is_writable_mapping_ = false;
};

}  // namespace

TypeFromEds type_from_eds(const Eds& eds, bool is_cst, const std::string& source) {
  return Maker(eds, is_cst).make(source);
}

}  // namespace liana::commissioning
