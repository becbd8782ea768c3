#include "host/storage/archive/ros2_messages.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "host/storage/recording/codec.hpp"

namespace liana::archive::ros2 {
namespace {

struct Definition {
  std::string_view name;  // PACKAGE/Type
  const char* fields;
};

// Fields of ROS' own packages. They are what a reader goes by, in this order.
constexpr Definition kDefinitions[]{
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/String", "string data\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {"geometry_msgs/Wrench", "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n"},
    {"geometry_msgs/WrenchStamped", "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n"},
    {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/JointState",
     "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"},
    {"diagnostic_msgs/KeyValue", "string key\nstring value\n"},
    {"diagnostic_msgs/DiagnosticStatus",
     "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\n"
     "string hardware_id\ndiagnostic_msgs/KeyValue[] values\n"},
    {"diagnostic_msgs/DiagnosticArray", "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"},
};

const Definition& find(std::string_view name) {
  const auto* const found = std::ranges::find(kDefinitions, name, &Definition::name);
  if (found == std::end(kDefinitions)) throw std::invalid_argument(std::string(name) + ": no such message");
  return *found;
}

// PACKAGE/msg/Type without its middle, as definitions name each other.
std::string short_name(std::string name) { return name.erase(name.find("/msg/"), 4); }

// Appends what the fields are made of, each message once, before what that is made of.
void add_parts(const Definition& definition, std::vector<const Definition*>& parts) {
  std::istringstream lines(definition.fields);
  for (std::string type, rest; lines >> type && std::getline(lines, rest);) {
    if (type.find('/') == std::string::npos) continue;
    const Definition& part = find(type.substr(0, type.find('[')));
    if (std::ranges::find(parts, &part) != parts.end()) continue;
    parts.push_back(&part);
    add_parts(part, parts);
  }
}

// Values are aligned to their size, counted from behind the encapsulation's header.
class Cdr {
 public:
  template <class T>
  void put(T value) {
    out_.resize((out_.size() + sizeof(T) - 1) / sizeof(T) * sizeof(T));
    recording::Writer writer(out_);
    writer("", value);
  }
  void put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    out_ += text + '\0';
  }
  void put(const std::vector<double>& values) {
    count(values.size());
    for (const double value : values) put(value);
  }
  void put(const Vec3& v) {
    for (const double value : v) put(value);
  }
  void put(const Quat& q) {
    for (const double value : {q[1], q[2], q[3], q[0]}) put(value);
  }
  void put(const Pose& pose) {
    put(pose.position_m);
    put(pose.quaternion);
  }
  void put(const Header& header) {
    constexpr std::uint64_t kSecond_ns = 1'000'000'000;
    put(static_cast<std::int32_t>(header.time_ns / kSecond_ns));
    put(static_cast<std::uint32_t>(header.time_ns % kSecond_ns));
    put(header.frame);
  }
  void count(std::size_t entries) { put(static_cast<std::uint32_t>(entries)); }
  std::string finished() const { return std::string("\0\1\0\0", 4) + out_; }

 private:
  std::string out_;
};

}  // namespace

std::string definition_of(const std::string& name) {
  const Definition& top = find(short_name(name));
  std::vector<const Definition*> parts;
  add_parts(top, parts);
  std::string out = top.fields;
  for (const Definition* part : parts)
    out += std::string(80, '=') + "\nMSG: " + std::string(part->name) + "\n" + part->fields;
  return out;
}

std::string joint_state(const Header& header, const JointState& joints) {
  Cdr out;
  out.put(header);
  out.count(joints.names.size());
  for (const std::string& name : joints.names) out.put(name);
  out.put(joints.positions);
  out.put(std::vector<double>{});  // velocities are not measured
  out.put(joints.efforts);
  return out.finished();
}

std::string transforms(std::uint64_t time_ns, const std::vector<Transform>& transforms) {
  Cdr out;
  out.count(transforms.size());
  for (const Transform& each : transforms) {
    out.put(Header{time_ns, each.parent});
    out.put(each.child);
    out.put(each.pose);
  }
  return out.finished();
}

std::string pose(const Header& header, const Pose& pose) {
  Cdr out;
  out.put(header);
  out.put(pose);
  return out.finished();
}

std::string wrench(const Header& header, const Vec3& force_N, const Vec3& torque_Nm) {
  Cdr out;
  out.put(header);
  out.put(force_N);
  out.put(torque_Nm);
  return out.finished();
}

std::string diagnostics(const Header& header, const Diagnostic& status) {
  Cdr out;
  out.put(header);
  out.count(1);
  out.put(status.level);
  for (const std::string* text : {&status.name, &status.message, &status.hardware}) out.put(*text);
  out.count(status.values.size());
  for (const auto& [key, value] : status.values) {
    out.put(key);
    out.put(value);
  }
  return out.finished();
}

std::string text(const std::string& value) {
  Cdr out;
  out.put(value);
  return out.finished();
}

// Numbers as rmw has them: history 1 the last ones, 3 what the system has; reliability 1 reliable; durability
// 1 transient local, 2 volatile; liveliness 1 automatic. The longest time is "no limit".
std::string quality_of_service(bool is_latched) {
  const std::string for_ever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return std::string("- history: ") + (is_latched ? "1\n  depth: 1" : "3\n  depth: 0") +
         "\n  reliability: 1\n  durability: " + (is_latched ? "1" : "2") + "\n  deadline:" + for_ever +
         "  lifespan:" + for_ever + "  liveliness: 1\n  liveliness_lease_duration:" + for_ever +
         "  avoid_ros_namespace_conventions: false\n";
}

}  // namespace liana::archive::ros2
