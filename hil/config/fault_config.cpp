#include "hil/config/fault_config.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "hil/config/fault_kinds.hpp"
#include "hil/config/fields.hpp"
#include "hil/config/json_file.hpp"

namespace liana::bench {

namespace {

constexpr int kMaxSlots = 2000000000;

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Fewest letters to add, leave out or replace that make one word of the other.
std::size_t letters_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t before = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = before + (a[i - 1] == b[j - 1] ? 0 : 1);
      before = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

// What is allowed in place of `given`: the name that is near, or "a, b, c".
std::string allowed_names(const std::string& given, const std::vector<std::string>& names) {
  constexpr std::size_t kNear = 2;
  const auto nearer = [&](const std::string& a, const std::string& b) {
    return letters_between(given, a) < letters_between(given, b);
  };
  const auto nearest = std::min_element(names.begin(), names.end(), nearer);
  const bool is_near = nearest != names.end() && letters_between(given, *nearest) <= std::min(kNear, given.size() / 2);
  return is_near ? "did you mean " + *nearest + "?" : "allowed are " + listed(names);
}

void refuse_others(const JsonFile& file, const std::string& field, const std::vector<std::string>& allowed) {
  for (const std::string& key : file.keys(field))
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
      file.fail(field + "/" + key, "is not known here; " + allowed_names(key, allowed));
}

// Kinds that had another name before, and the present one.
constexpr std::array<std::pair<const char*, const char*>, 2> kRetiredKinds{{
    {"push", "external_force"},
    {"node_twice", "duplicate_node_id"},
}};

const KindOfFault& read_kind(const JsonFile& file, const std::string& field) {
  const std::string name = file.text(field);
  std::vector<std::string> names;
  for (const KindOfFault& kind : kinds_of_faults()) {
    if (name == kind.name) return kind;
    names.emplace_back(kind.name);
  }
  for (const auto& [before, now] : kRetiredKinds)
    if (name == before) file.fail(field, "is \"" + name + "\", which is called \"" + now + "\" now");
  file.fail(field, "is \"" + name + "\"; " + allowed_names(name, names));
}

std::vector<std::size_t> read_drives(const JsonFile& file, const std::string& field, std::size_t count) {
  const auto drive_at = [&](const std::string& place) {  // counted from 1
    return static_cast<std::size_t>(file.integer(place, 1, static_cast<int>(count)) - 1);
  };
  std::vector<std::size_t> drives;
  if (file.is_text(field)) {
    if (file.text(field) != "all")
      file.fail(field, "is \"" + file.text(field) + "\"; allowed are a drive's number, a list of them, or \"all\"");
    for (std::size_t i = 0; i < count; ++i) drives.push_back(i);
    return drives;
  }
  if (!file.is_list(field)) return {drive_at(field)};
  for (std::size_t i = 0; i < file.size(field); ++i) drives.push_back(drive_at(field + "/" + std::to_string(i)));
  if (drives.empty()) file.fail(field, "is an empty list; name at least one drive");
  std::vector<std::size_t> sorted = drives;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    file.fail(field, "names a drive twice; name each once");
  return drives;
}

std::uint32_t read_slots(const JsonFile& file, const std::string& field, int low) {
  return static_cast<std::uint32_t>(file.integer(field, low, kMaxSlots));
}

FaultCondition read_condition(const JsonFile& file, const std::string& field, std::size_t theta_count) {
  refuse_others(file, field,
                {"theta", "above_deg", "below_deg", "enabled", "moving", "depth_above_m", "depth_below_m",
                 "contact_above_N", "captured", "carried_above", "after_first_slots", "for_slots"});
  FaultCondition when;
  const bool above = file.has(field + "/above_deg");
  const bool below = file.has(field + "/below_deg");
  if (file.has(field + "/theta")) {
    when.theta = static_cast<std::size_t>(file.integer(field + "/theta", 1, static_cast<int>(theta_count)) - 1);
    if (!above && !below) file.fail(field, "names theta, but neither above_deg nor below_deg; add one");
  } else if (above || below) {
    file.fail(field + "/theta",
              "is missing beside above_deg or below_deg; allowed is 1 to " + std::to_string(theta_count));
  }
  if (above) when.above_rad = kRadPerDeg * file.number(field + "/above_deg", -180.0, 180.0);
  if (below) when.below_rad = kRadPerDeg * file.number(field + "/below_deg", -180.0, 180.0);
  for (const auto& [name, flag] : {std::pair{"/enabled", &when.enabled}, std::pair{"/moving", &when.moving},
                                   std::pair{"/captured", &when.captured}}) {
    if (!file.has(field + name)) continue;
    if (!file.is_true(field + name)) file.fail(field + name, "can only be true; leave it out instead");
    *flag = true;
  }
  if (file.has(field + "/depth_above_m")) when.depth_above_m = file.number(field + "/depth_above_m", -10.0, 10.0);
  if (file.has(field + "/depth_below_m")) when.depth_below_m = file.number(field + "/depth_below_m", -10.0, 10.0);
  if (file.has(field + "/contact_above_N")) when.contact_above_N = file.number(field + "/contact_above_N", 0.0, 1000.0);
  if (file.has(field + "/carried_above")) when.carried_above = file.number(field + "/carried_above", 0.0, 1.0);
  if (file.has(field + "/after_first_slots"))
    when.after_first_slots = read_slots(file, field + "/after_first_slots", 0);
  const bool about_payload = when.contact_above_N || when.captured || when.carried_above;
  const bool about_depth = when.depth_above_m || when.depth_below_m;
  if (!when.theta && !when.enabled && !when.moving && !about_depth && !about_payload && !when.after_first_slots)
    file.fail(field,
              "names no condition; add theta, enabled, moving, depth_above_m, depth_below_m, contact_above_N, "
              "captured, carried_above or after_first_slots");
  if (file.has(field + "/for_slots")) when.for_slots = read_slots(file, field + "/for_slots", 1);
  return when;
}

FaultParameters read_parameters(const JsonFile& file, const std::string& field, const KindOfFault& kind) {
  FaultParameters values;
  for (const FaultValue& parameter : kind.values) {
    const std::string name = field + "/" + parameter.name;
    if (!parameter.required && !file.has(name)) continue;
    values.*parameter.value =
        parameter.whole ? file.integer(name, static_cast<int>(parameter.low), static_cast<int>(parameter.high))
                        : file.number(name, parameter.low, parameter.high);
  }
  if (kind.kind == FaultKind::kNoisy && values.counts == 0.0 && values.permille == 0.0)
    file.fail(field, "is noisy by nothing; add counts or permille above 0");
  if (kind.kind == FaultKind::kCableSlip && values.length_m == 0.0)
    file.fail(field + "/length_m", "is 0; allowed is -0.1 to 0.1 but 0");
  if (kind.kind == FaultKind::kCameraJump && values.length_m == 0.0)
    file.fail(field + "/length_m", "is 0; allowed is -1 to 1 but 0");
  if (kind.kind == FaultKind::kPush && values.x_N == 0.0 && values.y_N == 0.0 && values.z_N == 0.0)
    file.fail(field, "is pushed by nothing; add x_N, y_N or z_N other than 0");
  if (kind.kind == FaultKind::kBaseMoved && values.x_m == 0.0 && values.y_m == 0.0 && values.z_m == 0.0)
    file.fail(field, "moves the base by nothing; add x_m, y_m or z_m other than 0");
  return values;
}

bool names_drives(const KindOfFault& kind) {
  return kind.of == FaultOf::kDrive || kind.of == FaultOf::kCable || kind.of == FaultOf::kBase;
}

// What a fault is, without when it begins.
FaultConfig read_what(const JsonFile& file, const std::string& field, std::size_t drive_count,
                      std::vector<std::string> allowed) {
  const KindOfFault& kind = read_kind(file, field + "/kind");
  allowed.emplace_back("kind");
  if (names_drives(kind)) allowed.emplace_back("drive");
  if (kind.can_end) allowed.emplace_back("for_slots");
  for (const FaultValue& parameter : kind.values) allowed.emplace_back(parameter.name);
  refuse_others(file, field, allowed);

  FaultConfig fault;
  if (names_drives(kind)) fault.drives = read_drives(file, field + "/drive", drive_count);
  fault.kind = kind.kind;
  fault.name = kind.name;
  if (file.has(field + "/for_slots")) fault.for_slots = read_slots(file, field + "/for_slots", 1);
  fault.parameters = read_parameters(file, field, kind);
  return fault;
}

FaultConfig read_fault(const JsonFile& file, const std::string& field, std::size_t drive_count,
                       std::size_t theta_count) {
  FaultConfig fault = read_what(file, field, drive_count, {"at_slot", "when"});
  if (file.has(field + "/at_slot") == file.has(field + "/when"))
    file.fail(field, "needs exactly one of at_slot and when");
  if (file.has(field + "/at_slot")) fault.at_slot = read_slots(file, field + "/at_slot", 0);
  if (file.has(field + "/when")) fault.when = read_condition(file, field + "/when", theta_count);
  return fault;
}

}  // namespace

void refuse_faults(const std::vector<FaultConfig>& faults, const std::vector<FaultOf>& of, const std::string& why) {
  for (const FaultConfig& fault : faults)
    if (std::find(of.begin(), of.end(), fault_of(fault.kind)) != of.end())
      throw std::runtime_error("--faults: kind \"" + fault.name + "\" " + why);
}

void refuse_payload_faults(const std::vector<FaultConfig>& faults, const std::string& why) {
  refuse_faults(faults, {FaultOf::kPayload}, "happens where a payload is installed" + why);
  for (const FaultConfig& fault : faults)
    if (fault.when.contact_above_N || fault.when.captured || fault.when.carried_above)
      throw std::runtime_error("--faults: kind \"" + fault.name +
                               "\": when waits for contact, capture or carrying of a payload" + why);
}

std::vector<FaultConfig> load_faults(const std::string& path, std::size_t drive_count, std::size_t theta_count) {
  const JsonFile file(path, "");
  std::vector<FaultConfig> faults;
  for (std::size_t i = 0; i < file.size(""); ++i)
    faults.push_back(read_fault(file, "/" + std::to_string(i), drive_count, theta_count));
  return faults;
}

std::vector<FaultConfig> faults_at(std::uint32_t slot, const std::string& text, std::size_t drive_count) {
  const JsonFile list = JsonFile::of_text("faults", text);
  if (!list.is_list("")) list.fail("", "is no list of faults; send one");
  std::vector<FaultConfig> faults;
  for (std::size_t i = 0; i < list.size(""); ++i) {
    faults.push_back(read_what(list, "/" + std::to_string(i), drive_count, {}));
    faults.back().at_slot = slot;
  }
  return faults;
}

}  // namespace liana::bench
