#include "host/drives/calibration/table_fields.hpp"

#include <algorithm>

#include "firmware_like/math/pose.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;
using Slot = double* (*)(RobotParams&, Index);

std::string of_segment(Index j, const char* field) { return "segments[" + std::to_string(j) + "]." + field; }
std::string at_index(const char* field, Index i) { return std::string(field) + "[" + std::to_string(i) + "]"; }

struct Fields {
  RobotParams table;
  std::vector<TableField> list{};

  double value(Slot slot, Index index) { return *slot(table, index); }
  void add(std::string field, double sd, Slot slot, Index index) {
    const double is = value(slot, index);
    list.push_back({std::move(field), is, sd, is, sd, slot, index});
  }
  // Known to a share of its value.
  void add_share(std::string field, double share, Slot slot, Index index) {
    add(std::move(field), share * value(slot, index), slot, index);
  }
};

const FieldValue* of(const std::vector<FieldValue>& values, const std::string& field) {
  const auto found = std::ranges::find(values, field, &FieldValue::field);
  return found == values.end() ? nullptr : &*found;
}

}  // namespace

std::vector<TableField> geometry_fields(const RobotParams& table) {
  Fields out{table};
  const Index base = static_cast<Index>(table.first_bending()), segments = static_cast<Index>(table.segment_count);
  for (Index j = base; j < segments; ++j)
    out.add_share(
        of_segment(j - base, "module_length_m"), kPriorLength,
        [](RobotParams& t, Index i) { return &t.segment[i].module_length_m; }, j);
  for (Index j = base; j < segments; ++j)
    out.add_share(
        at_index("cables.hole_radius_m", j - base), kPriorHoleRadius,
        [](RobotParams& t, Index i) { return &t.segment[i].hole_radius_m; }, j);
  out.add_share(
      "cables.EA_N", kPriorEA, [](RobotParams& t, Index) { return &t.cable_EA_N; }, 0);
  return out.list;
}

std::vector<TableField> load_fields(const RobotParams& table) {
  Fields out{table};
  const double gravity = norm(table.gravity_m_s2);
  const Index base = static_cast<Index>(table.first_bending());
  for (Index j = base; j < static_cast<Index>(table.segment_count); ++j) {
    const SegmentParams& segment = table.segment[j];
    if (gravity > 0.0) {
      out.add_share(
          of_segment(j - base, "module_mass_kg"), kPriorMass,
          [](RobotParams& t, Index i) { return &t.segment[i].module_mass_kg; }, j);
      out.add(
          of_segment(j - base, "module_center"), kPriorCenter_m / segment.module_length_m,
          [](RobotParams& t, Index i) { return &t.segment[i].module_center; }, j);
    }
    if (segment.joint_stiffness_Nm_rad > 0.0)
      out.add_share(
          of_segment(j - base, "joint_stiffness_Nm_per_rad"), kPriorStiffness,
          [](RobotParams& t, Index i) { return &t.segment[i].joint_stiffness_Nm_rad; }, j);
  }
  if (gravity > 0.0 && table.tool.mass_kg > 0.0) {
    out.add_share(
        "tool.mass_kg", kPriorMass, [](RobotParams& t, Index) { return &t.tool.mass_kg; }, 0);
    for (Index axis = 0; axis < 3; ++axis)
      out.add(
          at_index("tool.center_m", axis), kPriorCenter_m,
          [](RobotParams& t, Index i) { return &t.tool.center_in_tip_m[i]; }, axis);
  }
  for (Index axis = 0; gravity > 0.0 && axis < 3; ++axis)
    out.add(
        at_index("gravity_m_s2", axis), kPriorGravity * gravity,
        [](RobotParams& t, Index i) { return &t.gravity_m_s2[i]; }, axis);
  return out.list;
}

std::vector<TableField> table_fields(const RobotParams& table) {
  std::vector<TableField> out = geometry_fields(table);
  for (TableField& one : load_fields(table)) out.push_back(std::move(one));
  return out;
}

void know(const std::vector<FieldValue>& values, std::vector<TableField>& fields) {
  for (TableField& field : fields) {
    const FieldValue* known = of(values, field.field);
    if (known == nullptr) continue;
    field.known_value = known->value;
    field.known_sd = known->sd;
  }
}

void set_fields(const std::vector<TableField>& fields, const std::vector<FieldValue>& values, RobotParams& table) {
  for (const TableField& field : fields) {
    if (const FieldValue* found = of(values, field.field)) *field.slot(table, field.index) = found->value;
  }
}

std::vector<FieldValue> merged(const std::vector<TableField>& fields, const std::vector<FieldValue>& known,
                               const std::vector<FieldValue>& found) {
  std::vector<FieldValue> out;
  for (const TableField& field : fields) {
    const FieldValue* now = of(found, field.field);
    if (now == nullptr) now = of(known, field.field);
    if (now != nullptr) out.push_back(*now);
  }
  return out;
}

}  // namespace liana::calibration
