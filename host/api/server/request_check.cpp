#include "host/api/server/request_check.hpp"

#include <algorithm>

#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"
#include "host/base/json/json.hpp"
#include "host/base/options/retired.hpp"

namespace liana::api {

namespace {

constexpr double kQuaternionEntry = 1.001;  // its length is checked besides

std::string brief(const Json& value) { return value.dump(-1, Json::BadUtf8::kReplace).substr(0, 60); }

[[noreturn]] void refuse(const char* code, const std::string& what, const std::string& allowed, const char* advice) {
  throw RequestError(code, what + ": allowed " + allowed + ": " + advice);
}

[[noreturn]] void wrong_type(const std::string& name, const Json& value, const std::string& allowed) {
  refuse("bad_request", name + " = " + brief(value), allowed, "correct it");
}

// The robot has another kind of arm than this is for.
[[noreturn]] void wrong_arm(const std::string& what, Arms for_arms, const RequestBounds& bounds) {
  const std::string one_arm = bounds.arm == kCableArm ? "cable arm" : "serial arm";
  throw RequestError("refused", what + ": for " + arms_text(for_arms) + " only; robot " + bounds.robot + " has a " +
                                    one_arm + ": leave it out");
}

// What is refused inside an entry or an object says where.
template <class Body>
void inside(const std::string& where, const Body& body) {
  try {
    body();
  } catch (const RequestError& error) {
    throw RequestError(error.code(), where + ": " + error.what());
  }
}

// One check of one request.
class Check {
 public:
  Check(const Json& request, const RequestBounds* bounds, std::size_t first)
      : request_(request), bounds_(bounds), first_(first) {}

  void fields_of(const Json& object, std::span<const RequestField> fields) const {
    only_known(object, fields);
    for (const RequestField& field : fields) {
      const Json* value = object.find(field.name);
      if (value != nullptr && value->is_null() && field.need == Need::kOrNull) continue;
      if (value != nullptr) {
        given(field, *value, object);
      } else if (field.need == Need::kRequired) {
        refuse("bad_request", std::string(field.name) + " is missing",
               field.most > 0 ? allowed_entries(field) : type_text(field), "add it");
      }
    }
  }

 private:
  void only_known(const Json& object, std::span<const RequestField> fields) const {
    std::string names;
    for (const RequestField& field : fields) names += (names.empty() ? "" : ", ") + std::string(field.name);
    for (const auto& member : object.items()) {
      const std::string& key = member.first;
      if (&object == &request_ && (key == "op" || key == "id")) continue;
      const auto found =
          std::find_if(fields.begin(), fields.end(), [&](const RequestField& field) { return key == field.name; });
      if (found == fields.end()) {
        const std::string_view present = present_field(key);
        const std::string now = options::called_now(present);
        refuse("bad_request", "unknown field " + key.substr(0, 60) + " = " + brief(member.second),
               names.empty() ? "none" : names, present.empty() ? "correct its spelling or remove it" : now.c_str());
      }
      if (bounds_ != nullptr && (found->arms & bounds_->arm) == 0) wrong_arm(key, found->arms, *bounds_);
    }
  }

  static std::string allowed_entries(const RequestField& field) {
    return "an array of at most " + std::to_string(field.most) + " entries";
  }

  void given(const RequestField& field, const Json& value, const Json& beside) const {
    if (field.most == 0) return single(field, field.name, value, beside);
    const std::string allowed = allowed_entries(field);
    if (!value.is_array()) wrong_type(field.name, value, allowed);
    if (value.size() > field.most) {
      refuse("bad_request", std::string(field.name) + " = " + std::to_string(value.size()) + " entries", allowed,
             "leave some out");
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string entry = "entry " + std::to_string(i + 1);
      inside(entry + " of " + field.name, [&] { single(field, entry, value[i], beside); });
    }
  }

  void single(const RequestField& field, const std::string& name, const Json& value, const Json& beside) const {
    switch (field.type) {
      case FieldType::kNumber:
      case FieldType::kInteger:
        return number(field, name, value);
      case FieldType::kFlag:
        if (!value.is_boolean() && !value.is_number()) wrong_type(name, value, "true or false");
        return;
      case FieldType::kText:
        return text(field, name, value);
      case FieldType::kWord:
        if (!value.is_string() || std::find(field.words.begin(), field.words.end(), value.text()) == field.words.end())
          wrong_type(name, value, type_text(field));
        return;
      case FieldType::kAngle:
        return angle(name, value, beside);
      case FieldType::kAngles:
        return angles(name, value);
      case FieldType::kPoint:
        array(name, value, 3);
        for (std::size_t i = 0; i < 3; ++i) coordinate(field, name, value, i);
        return;
      case FieldType::kPose:
        return pose(field, name, value);
      case FieldType::kObject:
        if (!value.is_object()) wrong_type(name, value, type_text(field));
        if (field.most > 0) return fields_of(value, field.fields);
        return inside(name, [&] { fields_of(value, field.fields); });
    }
  }

  void number(const RequestField& field, const std::string& name, const Json& value) const {
    const bool whole = field.type == FieldType::kInteger;
    if (!value.is_number() || (whole && !value.is_number_integer()))
      wrong_type(name, value, whole ? "a whole number" : "a number");
    if (bounds_ != nullptr) {
      in_range(name, value.get<double>(), bounds_->value_of(field.low), bounds_->value_of(field.high),
               unit_of(field.name));
    }
  }

  void in_range(const std::string& name, double value, double low, double high, const char* unit) const {
    if (value >= low && value <= high) return;
    refuse("out_of_range", name + " = " + text_of(value), text_of(low) + " to " + text_of(high) + unit,
           "choose another value");
  }

  void text(const RequestField& field, const std::string& name, const Json& value) const {
    const double most = field.high.factor;
    if (!value.is_string() || value.text().empty() || static_cast<double>(value.text().size()) > most)
      wrong_type(name, value, type_text(field));
  }

  // In the range of the angle whose number stands beside it.
  void angle(const std::string& name, const Json& value, const Json& beside) const {
    if (!value.is_number()) wrong_type(name, value, "a number");
    if (bounds_ == nullptr) return;
    const AngleRange& range = bounds_->angle_deg.at(beside.at("theta").get<std::size_t>() - 1);
    in_range(name, value.get<double>(), range.low_deg, range.high_deg, " deg");
  }

  void angles(const std::string& name, const Json& value) const {
    if (bounds_ != nullptr) {
      array(name, value, bounds_->angle_deg.size());
    } else if (!value.is_array()) {
      wrong_type(name, value, "an array of numbers");
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string entry = name + entry_text(i);
      if (!value[i].is_number()) wrong_type(entry, value[i], "a number");
      if (bounds_ == nullptr) continue;
      const AngleRange& range = bounds_->angle_deg[i];
      in_range(entry + " (" + bounds_->angle_name() + " " + std::to_string(i + 1) + ")", value[i].get<double>(),
               range.low_deg, range.high_deg, " deg");
    }
  }

  void array(const std::string& name, const Json& value, std::size_t count) const {
    const std::string allowed = "an array of " + std::to_string(count) + " numbers";
    if (!value.is_array()) wrong_type(name, value, allowed);
    if (value.size() != count)
      refuse("bad_request", name + " = " + std::to_string(value.size()) + " entries", allowed, "give as many");
    for (std::size_t i = 0; i < count; ++i) {
      if (!value[i].is_number()) wrong_type(name + entry_text(i), value[i], "a number");
    }
  }

  void coordinate(const RequestField& field, const std::string& name, const Json& value, std::size_t i) const {
    if (bounds_ == nullptr) return;
    const double most = i < 3 ? bounds_->value_of(field.high) : kQuaternionEntry;
    in_range(name + entry_text(i), value[i].get<double>(), -most, most, i < 3 ? " m" : "");
  }

  void pose(const RequestField& field, const std::string& name, const Json& value) const {
    array(name, value, 7);
    if (bounds_ == nullptr) return;
    for (std::size_t i = 0; i < 7; ++i) coordinate(field, name, value, i);
    const Pose pose = pose_of(value);
    const double most_m = bounds_->value_of(field.high), far_m = norm(pose.position_m);
    if (!is_valid(pose)) {
      refuse("out_of_range", name + ": the quaternion qw,qx,qy,qz = " + brief(value), "length 1 within 1e-6",
             "scale it");
    }
    if (far_m <= most_m) return;
    const bool of_arm = field.high.figure == Figure::kReach;
    throw RequestError("out_of_range", name + " = " + roughly(far_m) + " m from the " +
                                           (of_arm ? "base: the arm reaches " : "origin: allowed ") + text_of(most_m) +
                                           " m: choose a nearer one");
  }

  std::string entry_text(std::size_t i) const { return "[" + std::to_string(i + first_) + "]"; }

  const Json& request_;
  const RequestBounds* bounds_;
  std::size_t first_;
};

}  // namespace

const RequestRow& row_of(const Json& request) {
  const Json& op = request.member_or_null("op");
  if (!op.is_string() || op.text().empty() || op.text().size() > 32)
    wrong_type("op", op, "a text of 1 to 32 bytes, such as \"hold\"");
  const RequestRow* row = find_request(op.text());
  if (row == nullptr) {
    const std::string_view now = present_op(op.text());
    const std::string known = now.empty() ? "docs/reference/api.md lists them all" : options::called_now(now);
    throw RequestError("bad_request", "unknown op " + brief(op) + ": " + known);
  }
  return *row;
}

void require_may(const RequestRow& row, Role role, const RequestBounds& bounds) {
  if ((row.arms & bounds.arm) == 0) wrong_arm(row.op, row.arms, bounds);
  if ((row.roles & only(role)) != 0) return;
  const bool owns = (row.roles & only(Role::kClient)) != 0;
  refuse(owns ? "not_owner" : "bad_request", std::string(row.op) + " by role " + role_name(role), roles_text(row.roles),
         "connect with such a role");
}

void check_fields(const RequestRow& row, const Json& request, const RequestBounds* bounds, std::size_t first) {
  if (!row.never_refused) Check(request, bounds, first).fields_of(request, row.fields);
}

Arguments checked(const RequestRow& row, const Json& request, const RequestBounds& bounds) {
  check_fields(row, request, &bounds);
  return {request, row.fields, bounds};
}

}  // namespace liana::api
