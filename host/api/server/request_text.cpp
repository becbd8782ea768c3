#include "host/api/server/request_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace liana::api {

namespace {

std::string joined(Words words) {
  std::string out;
  for (const char* word : words) out += (out.empty() ? "" : ", ") + std::string(word);
  return out;
}

std::string names_of(std::span<const RequestField> fields) {
  std::string out;
  for (const RequestField& field : fields) out += (out.empty() ? "" : ", ") + std::string(field.name);
  return out;
}

}  // namespace

std::string text_of(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string roughly(double value) { return text_of(std::round(value * 1e6) / 1e6); }

const char* unit_of(std::string_view name) {
  if (name.ends_with("_deg_s")) return " deg/s";
  if (name.ends_with("_m_s")) return " m/s";
  if (name.ends_with("_deg")) return " deg";
  if (name.ends_with("_us")) return " us";
  if (name.ends_with("_s")) return " s";
  return name.ends_with("_m") && !name.ends_with("_per_m") ? " m" : "";
}

std::string type_text(const RequestField& field) {
  switch (field.type) {
    case FieldType::kNumber:
    case FieldType::kAngle:
      return "a number";
    case FieldType::kInteger:
      return "a whole number";
    case FieldType::kFlag:
      return "true or false";
    case FieldType::kText:
      return "a text of 1 to " + text_of(field.high.factor) + " bytes";
    case FieldType::kWord:
      return joined(field.words);
    case FieldType::kAngles:
      return "an array of numbers, one for each angle of the arm";
    case FieldType::kPoint:
      return "[x,y,z]";
    case FieldType::kPose:
      return "[x,y,z,qw,qx,qy,qz]";
    case FieldType::kObject:
      break;
  }
  return "an object with " + names_of(field.fields);
}

std::string roles_text(Roles roles) {
  std::string out;
  for (std::size_t i = 0; i < kRoleNames.size(); ++i) {
    if ((roles & only(static_cast<Role>(i))) != 0) out += (out.empty() ? "" : ", ") + std::string(kRoleNames[i]);
  }
  return out;
}

std::string arms_text(Arms arms) {
  return arms == kEveryArm ? "every arm" : arms == kCableArm ? "cable arms" : "serial arms";
}

}  // namespace liana::api
