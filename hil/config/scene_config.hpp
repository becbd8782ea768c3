// Scene and bus table as the bench reads them (docs/reference/formats.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hil/config/dictionary_config.hpp"
#include "hil/config/payload_config.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

// A box; `axis` are its three unit axes in base coordinates.
struct BoxConfig {
  std::string name;
  Vec3 center_m;
  std::array<double, 3> half_extent_m{};
  std::array<Vec3, 3> axis{};
};

struct SphereConfig {
  std::string name;
  Vec3 center_m;
  double radius_m = 0.0;
};

// A convex body: a hull of points, or a cylinder or capsule around the line between two.
struct ConvexConfig {
  enum class Kind { hull, cylinder, capsule };
  std::string name;
  Kind kind = Kind::hull;
  std::vector<Vec3> points_m;
  double radius_m = 0.0;  // of a cylinder or capsule
};

struct RodConfig {
  Pose pose;  // base frame; the rod is pressed along its x axis
  double radius_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

struct CameraConfig {
  double rate_hz = 25.0;
  double latency_s = 0.1;
  double noise_m = 0.0;
  double noise_rad = 0.0;
  double range_m = 0.0;
  double bias_m = 0.0;    // of every picture, in a direction that the seed draws
  double bias_rad = 0.0;  // likewise, of the attitude
  double dropout = 0.0;   // share of pictures that show nothing, drawn from the seed
};

struct ContactConfig {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double friction = 0.0;
};

struct SceneConfig {
  std::vector<BoxConfig> boxes;
  std::vector<SphereConfig> spheres;
  std::vector<ConvexConfig> convex;
  std::optional<Pose> slit_frame;  // base frame
  RodConfig rod;
  CameraConfig camera;
  ContactConfig contact;
  std::optional<PayloadConfig> payload;  // with it there is an adapter
  std::optional<AdapterConfig> adapter;
};

// How far the scene is from where its table has it.
struct SceneOffset {
  double distance_m = 0.0;
  double angle_rad = 0.0;
};

// The same scene moved as one body by exactly this much, the direction and the axis (through the mouth of its slit, its
// adapter, or its rod) drawn from `seed`.
SceneConfig displaced(const SceneConfig& scene, const SceneOffset& offset, std::uint64_t seed);

// How far a point in base coordinates is past the mouth of the slit, into it [m]; -1000 without a slit.
double depth_in_slit_m(const SceneConfig& scene, const Vec3& point_m);

// A node that reads load cells, one channel a cable.
struct LoadCellNodeConfig {
  int node = 0;
  std::size_t bus = 0;
  std::vector<std::size_t> cables;  // 0-based
  std::vector<double> zero_N;       // of each
};

// Which node sits on which bus, and the SYNC period.
// An axis of a node on a bus: where a drive is.
struct AxisConfig {
  int node = 1;
  int axis = 1;  // 1 or 2
  std::uint8_t bus = 0;
};

struct BusesConfig {
  std::vector<std::string> names;
  std::vector<AxisConfig> axes;  // of all buses, by node, then axis, as drives count
  std::uint32_t period_us = 4000;
  std::vector<LoadCellNodeConfig> load_cells;
  double newtons_per_step = 1.0;                 // of load cells
  std::map<int, DictionaryConfig> dictionaries;  // of drives whose dictionary is not the bench's own
  // Where drive i (0-based) is; throws std::runtime_error when it is on no bus.
  AxisConfig axis_of(std::size_t drive) const;
  // How many axes a node has.
  int axes_of(int node) const;
  DictionaryConfig dictionary_of(int node) const;
};

// All loaders throw std::runtime_error naming file, field, value and allowed range.
SceneConfig load_scene(const std::string& path);
BusesConfig load_buses(const std::string& path);

}  // namespace liana::bench
