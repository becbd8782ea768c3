// The shape of Foxglove's messages, as far as a reader needs it: every member with its type, all of them required.
#include <algorithm>
#include <stdexcept>

#include "host/storage/archive/foxglove.hpp"

namespace liana::archive::foxglove {
namespace {

Json of_type(const char* type) { return {{"type", type}}; }
Json array_of(const Json& items) { return {{"type", "array"}, {"items", items}}; }

Json object_of(const Json::Object& members, std::vector<std::string> optional = {}) {
  Json required = Json::array();
  for (const auto& [name, type] : members) {
    if (std::find(optional.begin(), optional.end(), name) == optional.end()) required.push_back(Json(name));
  }
  return {{"type", "object"}, {"required", required}, {"properties", Json(members)}};
}

Json numbers(const std::vector<const char*>& names) {
  Json::Object members;
  for (const char* name : names) members[name] = of_type("number");
  return object_of(members);
}

Json duration() { return object_of({{"sec", of_type("integer")}, {"nsec", of_type("integer")}}); }
Json xyz() { return numbers({"x", "y", "z"}); }
Json wxyz() { return numbers({"x", "y", "z", "w"}); }
Json pose() { return object_of({{"position", xyz()}, {"orientation", wxyz()}}); }
Json body(Json::Object more = {}) {
  more.insert({{"pose", pose()}, {"size", xyz()}, {"color", numbers({"r", "g", "b", "a"})}});
  return object_of(more);
}

Json entity() {
  const Json cylinder = body({{"bottom_scale", of_type("number")}, {"top_scale", of_type("number")}});
  Json::Object members{{"timestamp", duration()},     {"frame_id", of_type("string")},      {"id", of_type("string")},
                       {"lifetime", duration()},      {"frame_locked", of_type("boolean")}, {"cubes", array_of(body())},
                       {"spheres", array_of(body())}, {"cylinders", array_of(cylinder)}};
  for (const char* unused : {"metadata", "arrows", "lines", "triangles", "texts", "models"})
    members[unused] = array_of(of_type("object"));
  return object_of(members);
}

Json transform() {
  return object_of({{"timestamp", duration()},
                    {"parent_frame_id", of_type("string")},
                    {"child_frame_id", of_type("string")},
                    {"translation", xyz()},
                    {"rotation", wxyz()}});
}

Json joint() {
  Json::Object members{{"name", of_type("string")}};
  for (const char* number : {"position", "velocity", "effort"}) members[number] = of_type("number");
  return object_of(members, {"position", "velocity", "effort"});
}

Json message(const std::string& name) {
  if (name == "foxglove.SceneUpdate") {
    const Json deletion =
        object_of({{"timestamp", duration()}, {"type", of_type("integer")}, {"id", of_type("string")}});
    return object_of({{"deletions", array_of(deletion)}, {"entities", array_of(entity())}});
  }
  if (name == "foxglove.FrameTransforms") return object_of({{"transforms", array_of(transform())}});
  if (name == "foxglove.JointStates") return object_of({{"timestamp", duration()}, {"joints", array_of(joint())}});
  if (name == "foxglove.Log")
    return object_of({{"timestamp", duration()},
                      {"level", of_type("integer")},
                      {"message", of_type("string")},
                      {"name", of_type("string")},
                      {"file", of_type("string")},
                      {"line", of_type("integer")}});
  throw std::invalid_argument(name);
}

}  // namespace

std::string schema_of(const std::string& name) {
  Json schema = message(name);
  schema["title"] = name;
  return schema.dump();
}

}  // namespace liana::archive::foxglove
