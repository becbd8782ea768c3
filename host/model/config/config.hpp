// Robot, scene and buses: canonical JSON (docs/reference/formats.md) to checked C++ structs.
// Every function that reads throws std::runtime_error "file: field: value: allowed ...: what to do" on the first fault
// it finds.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::config {

// A node that reads load cells (CiA 404), one channel a cable, in the order of its channels.
struct LoadCellNode {
  std::int32_t node = 0;
  std::vector<std::size_t> cables;  // 0-based
  std::vector<double> zero_N;       // of each
};

// What all load cells of the buses have in common.
struct LoadCells {
  double newtons_per_step = 0.0;
  double range_N = 0.0;  // readings beyond count as none
  double agree_N = 0.0;  // most by which a cell and the torque of its drive may differ
  bool goes_on = false;  // without a cell that is lost, by torque
};

// Where a drive is. The drives of a bus table count by node, then by axis: with one axis a node, drive 4 is node 4.
struct DrivePlace {
  std::int32_t node = 0;  // CANopen node id, 1..126
  std::int32_t axis = 1;  // of the node, 1..kMaxAxes

  constexpr DrivePlace() = default;
  constexpr DrivePlace(std::int32_t node_id, std::int32_t axis_of_node = 1) : node(node_id), axis(axis_of_node) {}
  friend constexpr auto operator<=>(const DrivePlace&, const DrivePlace&) = default;
};
constexpr std::int32_t kMaxAxes = 2;  // of a node: its predefined identifiers are enough for the process data of two

// One CAN bus and the drives on it.
struct BusConfig {
  std::string name;               // interface name for socketcan
  std::int32_t bitrate = 0;       // bit/s
  std::vector<DrivePlace> nodes;  // of its drives
  std::int32_t wrist_sensor = 0;  // node of a serial arm's force sensor (docs/explanation/force-control.md); 0: none
  std::int32_t adapter = 0;       // node of the adapter; 0: none
  std::vector<LoadCellNode> load_cells{};

  // Nodes that are no drives.
  std::size_t sensors() const { return (wrist_sensor != 0) + (adapter != 0) + load_cells.size(); }
  // Nodes of its drives, each once.
  std::size_t drive_nodes() const;
};

// Frames of a bus beside commands and TPDO1 of its drives, in bits a second with worst stuffing.
double worst_extra_bits_per_s(const BusConfig& bus, double rate_hz, std::int32_t torque_drives);

// The machine that the controller runs on.
struct Machine {
  double mips = 500.0;       // million instructions a second of one processor
  double tick_share = 0.25;  // of the control period that a tick may take
};

// The buses, the control rate and the command interval.
struct BusesConfig {
  std::string name;
  std::string backend;  // "embedded" or "socketcan"
  double rate_hz = 0.0;
  double command_interval_s = 0.0;  // T_c, a whole number of ticks
  std::vector<BusConfig> buses;     // 1..8
  std::int32_t heartbeat_ms = 0;
  double max_load = 0.0;  // highest worst-case load accepted, 0..1
  Machine machine;
  LoadCells load_cell;
  std::string canonical_json;

  // Control period [s].
  double tick_s() const { return 1.0 / rate_hz; }
  // Control period [us]; the checker has made sure that it is whole.
  std::int32_t period_us() const;
  // T_c in ticks, at least 1.
  std::int32_t interval_ticks() const;
  // 0-based index of the bus that carries `node`, or -1.
  std::int32_t bus_of_node(std::int32_t node) const;
  // Where each drive is, in the order in which drives count.
  std::vector<DrivePlace> places() const;
};

// The period as object 60C2 holds it: value x 10^exponent seconds.
struct InterpolationPeriod {
  std::uint8_t value = 0;
  std::int8_t exponent = 0;
};

// 60C2 for a period of `period_us`; value 0 when CiA 402 cannot express it exactly.
InterpolationPeriod interpolation_period(std::int32_t period_us);

// How many drives of a bus are of a type that is driven by torque.
std::int32_t torque_drives(const BusesConfig& buses, std::size_t bus);

// Worst-case share of the wire (0..) of one bus: SYNC, RPDO1 and TPDO1 of every node each tick with worst stuffing,
// TPDO2 of torque drives, wrist sensor and adapter, heartbeats of all and the master, SDO traffic.
double worst_case_load(const BusesConfig& buses, std::size_t bus);

// What object 0x1018 of every drive must say.
struct DriveIdentity {
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
};

// The robot: what the core needs (table) and what only the host needs.
struct RobotConfig {
  std::string name;
  cable::RobotParams table{};  // mu, tick and T_c included
  DriveIdentity identity{};
  double rated_torque_Nm = 0.0;  // 6076, at the drum
  std::uint32_t counts_per_turn = 0;
  double gear = 1.0;  // motor turns per drum turn
  double drum_radius_m = 0.0;
  std::vector<std::uint32_t> drive_serials;                    // what 0x1018:4 of every drive must say; empty: anything
  std::vector<DrivePlace> drive_places;                        // of the bus table; empty: read without one
  std::int32_t calibration_days = 0;                           // how old a calibration may be
  double module_radius_m = 0.0;                                // of the capsules of every link
  double joint_viscous_Nms_per_rad = 0.0;                      // per theta
  Machine machine;                                             // that of the buses
  double friction_band = 0.2;                                  // share by which true friction may differ from mu
  std::map<std::string, std::vector<double>> named_poses_deg;  // theta_count angles each; "zero" always exists
  std::string start_pose;              // which of them a simulated arm begins with; empty: the table does not say
  std::vector<std::string> jig_poses;  // those with fixtures, for calibration; empty: the table does not say
  std::string canonical_json;
};

// A pose in the base frame.
struct ScenePose {
  Vec3 position_m{};
  std::array<double, 4> quaternion_wxyz{1.0, 0.0, 0.0, 0.0};  // unit length
};

// An oriented box.
struct SceneBox {
  std::string name;
  Vec3 center_m{};
  Vec3 half_extent_m{};            // along the rows of rotation
  std::array<Vec3, 3> rotation{};  // the three axes as rows, right-handed, in the base frame
};

// A sphere.
struct SceneSphere {
  std::string name;
  Vec3 center_m{};
  double radius_m = 0.0;
};

// A convex body: the hull of points, swept by a disc for a cylinder and by a ball for a capsule (convex_shape.hpp makes
// them).
struct SceneConvex {
  std::string name;
  std::vector<Vec3> points_m;       // 1..kMaxHullPoints
  std::array<Vec3, 2> disc_axes{};  // unit, at right angles, in the plane of the disc
  double disc_radius_m = 0.0;
  double round_m = 0.0;  // of the ball
  Vec3 center_m{};       // of the box along the base axes around all of it
  Vec3 half_extent_m{};
};
constexpr std::size_t kMaxHullPoints = 256;

// The slit between two parallel plates: its plane, and where it begins and ends along u.
struct SceneSlit {
  Vec3 normal{};  // n.p = offset_m on the plane
  double offset_m = 0.0;
  Vec3 u_axis{};  // into the slit
  Vec3 w_axis{};  // u x n
  double mouth_u_m = 0.0;
  double end_u_m = 0.0;
  double half_gap_m = 0.0;
  ScenePose frame;  // x = u, y = n, z = w, origin on the plane at the mouth
};

// The press rod: where the tip has to go.
struct SceneRod {
  ScenePose pose;
  double radius_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

// The tip camera.
struct SceneCamera {
  double rate_hz = 0.0;
  double latency_s = 0.0;
  double noise_m = 0.0;
  double noise_deg = 0.0;
  double range_m = 0.0;
  double bias_m = 0.0;    // of every picture
  double bias_deg = 0.0;  // likewise
  double dropout = 0.0;   // share of pictures that show nothing
};

// A payload that the arm installs.
struct ScenePayload {
  ScenePose pose;  // of its grapple, z towards its pins, where it begins
  double mass_kg = 0.0;
  Vec3 center_m{};                       // of mass, in its own frame: the grapple's
  std::array<double, 6> inertia_kgm2{};  // xx, yy, zz, xy, xz, yz about the centre
  double length_m = 0.0;                 // from the grapple to the tips of its pins
  double radius_m = 0.0;                 // of the capsule that it is looked at as, from end to end
  bool on_arm = false;                   // from the start; else the transfer mechanism holds it
  std::string fetch_pose;                // of the arm that carries, while it is fetched; empty: where that is locked
  double start_lateral_m = 0.0;          // with on_arm: so far beside the adapter's axis at most, in x and in y
  double start_tilt_deg = 0.0;           // and so much turned
};

// What contacts are made of.
struct SceneContact {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double friction = 0.0;
};

// What the scene asks of clearance bounds (docs/explanation/verification.md), and how far it may be from its nominal
// place.
struct SceneMargins {
  double prediction_m = 0.009;  // how much nearer the true arm may be than a predicted one: taken off every distance
  double slow_m = 0.003;        // at or below this claim the tip is slowed down
  double refuse_m = 0.0;        // at or below this one nothing should come nearer
  double shift_m = 0.0;         // until the camera has shown where it stands: so far beside where it is drawn
  double turn_deg = 0.0;        // and turned by so much about the slit frame's origin
};

// What a virtual fixture does about the tip (docs/explanation/virtual-fixtures.md).
enum class FixtureKind : std::uint8_t {
  kPlane,  // guides a hand: what it asks for is brought into the plane y = 0 of the frame; felt as that plane
  kWalls,  // forbids: the tip stays between two planes y = +-room; felt as these
  kAxis,   // is felt only: a funnel about the frame's x, as the way in
};

// A virtual fixture: of a tip in the box 0 <= x <= depth_m, |z| <= half_width_m, |y| <= half_gap_m of its frame.
struct SceneFixture {
  std::string name;
  FixtureKind kind = FixtureKind::kPlane;
  ScenePose frame;             // x the way in, y normal, z across
  double depth_m = 0.0;        // > 0
  double half_width_m = 0.0;   // > 0
  double half_gap_m = 0.0;     // > 0: to the real walls, the arm's radius included
  double yaw_low_deg = -90.0;  // plane: of the tip's x about y, from the frame's x; low <= high
  double yaw_high_deg = 90.0;
  double radius_m = 0.0;      // axis: half width of the funnel at its end, x = depth_m, > 0
  double opening_deg = 30.0;  // axis: how much it widens towards x = 0, to either side
};
constexpr std::size_t kMaxFixtures = 16;

// Everything around the arm.
struct SceneConfig {
  std::string name;
  std::vector<SceneBox> boxes;
  std::vector<SceneSphere> spheres;
  std::vector<SceneConvex> convex;    // a chain of capsules is one for each of its pieces, all with its name
  std::optional<SceneSlit> slit;      // none: nothing is asked to be planar, nowhere the tip has to be slow
  std::optional<SceneRod> rod;        // none: nothing to press
  std::optional<SceneCamera> camera;  // with contact what a bench needs to simulate the scene
  std::optional<SceneContact> contact;
  std::optional<ScenePayload> payload;  // with it there is an adapter
  std::optional<ScenePose> adapter;     // the middle of the socket's face, z into it
  SceneMargins margins;
  std::vector<SceneFixture> fixtures;  // a scene that names none has those of its slit (scene_parts.hpp)
  std::string canonical_json;
};

// Loads and checks the buses: rate expressible by CiA 402, T_c whole ticks, node ids unique, worst-case load within
// max_load.
BusesConfig load_buses(const std::string& path);

// Loads and checks the robot for these buses (every drive on exactly one bus); physics is "nominal", "ideal" or "worn"
// and chooses friction_mu.
RobotConfig load_robot(const std::string& path, const std::string& physics, const BusesConfig& buses);

// Loads and checks the scene: axes orthonormal, slit frame and plane consistent, sizes positive.
SceneConfig load_scene(const std::string& path);

// The same from JSON text; `file` is what messages call it.
BusesConfig parse_buses(const std::string& text, const std::string& file);
RobotConfig parse_robot(const std::string& text, const std::string& file, const std::string& physics,
                        const BusesConfig& buses);
SceneConfig parse_scene(const std::string& text, const std::string& file);

// Checks one table of kind "robot", "scene", "buses", "drive" or "budget" by itself and returns its canonical JSON.
std::string check_table(const std::string& kind, const Json& table, const std::string& file);

// SHA-256 (64 hex digits) over the canonical robot, scene and buses JSON, one line each.
std::string config_hash(const std::string& robot_json, const std::string& scene_json, const std::string& buses_json);

}  // namespace liana::config
