#include "host/api/server/request_pages.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "host/api/server/request_text.hpp"

namespace liana::api {

namespace {

constexpr std::size_t kStubWidth = 110;

std::string bound_text(const Bound& bound) {
  const char* name = "";
  switch (bound.figure) {
    case Figure::kOne:
      return bound.factor == kBiggestWhole ? "2^53" : text_of(bound.factor);
    case Figure::kReach:
      name = "the arm's reach";
      break;
    case Figure::kAngles:
      name = "the number of angles";
      break;
    case Figure::kAngleRate:
      name = "the robot's fastest angle rate";
      break;
    case Figure::kTipSpeed:
      name = "the robot's tip speed";
      break;
    case Figure::kNodes:
      name = "the number of nodes before the tip";
      break;
  }
  return (bound.factor == 1.0 ? "" : text_of(bound.factor) + " x ") + name;
}

std::string unit_text(const char* name) {
  const std::string unit = unit_of(name);
  return unit.empty() ? unit : " [" + unit.substr(1) + "]";
}

std::string range_text(const RequestField& field) {
  switch (field.type) {
    case FieldType::kNumber:
    case FieldType::kInteger:
      return ", " + bound_text(field.low) + " to " + bound_text(field.high) + unit_text(field.name);
    case FieldType::kAngle:
      return " in the range of this angle [deg]";
    case FieldType::kAngles:
      return ", each in its range [deg]";
    case FieldType::kPoint:
      return ", each within " + bound_text(field.high) + " [m]";
    case FieldType::kPose:
      return ", at most " + bound_text(field.high) + " [m] away";
    default:
      return "";
  }
}

std::string what_it_is(const RequestField& field) {
  const std::string one = type_text(field) + range_text(field);
  std::string out = field.most == 0 ? one : "up to " + std::to_string(field.most) + ", each " + one;
  return field.arms == kEveryArm ? out : out + "; " + arms_text(field.arms) + " only";
}

std::string left_out(const RequestField& field) {
  switch (field.need) {
    case Need::kRequired:
      return "required";
    case Need::kOptional:
      return field.most > 0 ? "none" : "nothing";
    case Need::kOrNull:
      return "null";
    case Need::kFallback:
      break;
  }
  if (field.type == FieldType::kFlag) return field.fallback.factor == 0.0 ? "false" : "true";
  return bound_text(field.fallback);
}

void add_fields(std::span<const RequestField> fields, const std::string& before, std::ostream& out) {
  for (const RequestField& field : fields) {
    out << "| `" << before << field.name << "` | " << what_it_is(field) << " | " << left_out(field) << " | "
        << field.doc << " |\n";
    add_fields(field.fields, before + field.name + (field.most > 0 ? "[]." : "."), out);
  }
}

std::string who(const RequestRow& row) {
  if (row.owner_only) return "owner of motion";
  return row.roles == kAnyRole ? "anyone" : roles_text(row.roles);
}

// `text` in lines of at most kStubWidth, each after `before`.
std::string comment(const std::string& before, const std::string& text) {
  std::istringstream words(text);
  std::string out, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && before.size() + line.size() + 1 + word.size() > kStubWidth) {
      out += before + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return out + before + line + "\n";
}

std::string type_in_stub(const RequestField& field, const std::string& class_name) {
  std::string one = lua_type(field);
  if (field.type == FieldType::kObject) return class_name + "." + field.name + (field.most > 0 ? "[]" : "");
  if (field.type == FieldType::kWord) {
    one.clear();
    for (const char* word : field.words) one += (one.empty() ? "\"" : "|\"") + std::string(word) + "\"";
  }
  return one;
}

// The class of the fields, after those of the objects in it.
void add_class(const std::string& name, std::span<const RequestField> fields, std::ostream& out) {
  for (const RequestField& field : fields) {
    if (!field.fields.empty()) add_class(name + "." + field.name, field.fields, out);
  }
  out << "\n---@class " << name << "\n";
  for (const RequestField& field : fields) {
    const std::string default_text = field.need == Need::kFallback ? " (else " + left_out(field) + ")" : "";
    out << comment("---", field.doc + default_text) << "---@field " << field.name
        << (field.need == Need::kRequired ? " " : "? ") << type_in_stub(field, name) << "\n";
  }
}

std::pair<std::size_t, std::size_t> place_of(const MadeSection& section, const std::string& text) {
  const std::size_t begin = text.find(section.begin);
  const std::size_t after = begin + std::string(section.begin).size();
  const std::size_t end = begin == std::string::npos ? begin : text.find(section.end, after);
  if (end == std::string::npos)
    throw std::runtime_error(std::string(section.file) + ": the lines around the made section are missing");
  return {after, end};
}

}  // namespace

std::string request_section() {
  std::ostringstream out;
  out << "| op | who may | for | what |\n|---|---|---|---|\n";
  for (const RequestRow& row : request_table()) {
    out << "| `" << row.op << "` | " << who(row) << " | " << arms_text(row.arms) << " | " << row.doc << " |\n";
  }
  for (const RequestRow& row : request_table()) {
    if (row.fields.empty()) continue;
    out << "\n### Fields of `" << row.op << "`\n| field | what it is | left out | meaning |\n|---|---|---|---|\n";
    add_fields(row.fields, "", out);
    if (row.motion == Motion::kStreams) {
      out << "\nA `goal` that is farther than the tip comes in " << text_of(kJump_s)
          << " s at the robot's tip speed and tip rate, both from the `goal` before it and from where the tip is "
             "commanded, is refused: `move_cp` goes there.\n";
    }
  }
  return out.str();
}

std::string lua_type(const RequestField& field) {
  switch (field.type) {
    case FieldType::kNumber:
    case FieldType::kAngle:
      return "number";
    case FieldType::kInteger:
      return "integer";
    case FieldType::kFlag:
      return "boolean";
    case FieldType::kText:
    case FieldType::kWord:
      return "string";
    case FieldType::kObject:
      return field.most > 0 ? "table[]" : "table";
    default:
      return field.most > 0 ? "number[][]" : "number[]";
  }
}

std::string command_stubs() {
  std::ostringstream out;
  for (const RequestRow& row : request_table()) {
    if (!row.in_missions) continue;
    const std::string name = row.op;
    const bool has_fields = !row.fields.empty();
    if (has_fields) add_class("arm." + name, row.fields, out);
    out << "\n" << comment("---", row.doc + (row.arms == kEveryArm ? "" : " For " + arms_text(row.arms) + " only."));
    const bool needs_fields = std::any_of(row.fields.begin(), row.fields.end(),
                                          [](const RequestField& field) { return field.need == Need::kRequired; });
    if (has_fields) out << "---@param fields" << (needs_fields ? " arm." : "? arm.") << name << "\n";
    out << "---@return integer id\nfunction arm." << name << (has_fields ? "(fields) end\n" : "() end\n");
  }
  return out.str();
}

std::string section_of(const MadeSection& section, const std::string& text) {
  const auto [begin, end] = place_of(section, text);
  return text.substr(begin, end - begin);
}

std::string with_section(const MadeSection& section, const std::string& text, const std::string& made) {
  const auto [begin, end] = place_of(section, text);
  return text.substr(0, begin) + made + text.substr(end);
}

}  // namespace liana::api
