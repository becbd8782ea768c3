// Every shipped arm as MJCF: MuJoCo loads it, places its tip and its cables as the core does, and holds it in its
// named poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/serial/kinematics.hpp"
#include "hil/arm/mujoco_model.hpp"
#include "host/model/config/bench_buses.hpp"
#include "host/model/description/formats.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::description {
namespace {

constexpr double kEqual = 1e-9;  // m, and sine of an angle

std::vector<std::string> shipped(const char* folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(LIANA_LUA_DIR) + "/" + folder))
    names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

// A shipped arm of either kind, its model in MuJoCo, and what the core says of it.
class Arm {
 public:
  explicit Arm(const std::string& name, const std::vector<Shape>& scene = {}) {
    const std::string table = config::good_table("robot", name).dump();
    const std::string buses = config::bench_buses(config::drive_count(table, name));
    if (config::robot_kind(table, name) == "serial") {
      serial_ = config::parse_serial_robot(table, name);
      tree_ = tree_of(*serial_);
    } else {
      cable_ = config::parse_robot(table, name, "nominal", config::parse_buses(buses, name));
      tree_ = tree_of(*cable_);
    }
    engine_.emplace(mjcf(tree_, scene));
  }
  const RobotTree& tree() const { return tree_; }
  const mjModel& model() const { return *engine_->model; }
  mjData& data() { return *engine_->data; }

  void load_key(int key) {
    mj_resetDataKeyframe(engine_->model, engine_->data, key);
    mj_forward(engine_->model, engine_->data);
  }
  void step() { mj_step(engine_->model, engine_->data); }
  const TreePose& pose_of_key(int key) const {
    return tree_.poses.at(engine_->model->names + engine_->model->name_keyadr[key]);
  }
  Pose tip() const {
    const int site = mj_name2id(engine_->model, mjOBJ_SITE, "tip");
    Pose pose;
    mjtNum quaternion[4];
    mju_mat2Quat(quaternion, engine_->data->site_xmat + 9 * site);
    for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = engine_->data->site_xpos[3 * site + static_cast<int>(i)];
    for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = quaternion[i];
    return pose;
  }
  Pose tip_of_core(const std::vector<double>& angle_rad) const {
    if (serial_) return serial::forward_kinematics(serial_->table, joints(angle_rad)).tip_in_base;
    return cable::forward_kinematics(cable_->table, thetas(angle_rad)).tip_in_base;
  }
  // Those with holes.
  std::vector<double> cables_of_core_m(const std::vector<double>& angle_rad) const {
    if (serial_) return {};
    const cable::RobotParams& table = cable_->table;
    const auto geometry = cable_geometry(table, cable_layout(table), arm_trig(table, thetas(angle_rad)));
    const auto all = cable::of_cables(table, geometry.length_m);
    return {all.begin(), all.end()};
  }
  double mass_of_table_kg() const {
    double sum_kg = 0.0;
    if (serial_) {
      for (const serial::LinkMass& link : serial_->masses.link) sum_kg += link.mass_kg;
      if (serial_->base)
        for (const serial::LinkMass& link : serial_->base->masses.link) sum_kg += link.mass_kg;
      return sum_kg;
    }
    for (std::int32_t m = 0; m < cable_->table.segment_count; ++m) {
      const cable::SegmentParams& each = cable_->table.segment[static_cast<std::size_t>(m)];
      sum_kg += std::max(1, each.modules) * each.module_mass_kg;
    }
    return sum_kg + cable_->table.tool.mass_kg;
  }

 private:
  static cable::ThetaVector thetas(const std::vector<double>& angle_rad) {
    cable::ThetaVector out{};
    std::copy(angle_rad.begin(), angle_rad.end(), out.begin());
    return out;
  }
  static serial::JointVector joints(const std::vector<double>& angle_rad) {
    serial::JointVector out{};
    std::copy(angle_rad.begin(), angle_rad.end(), out.begin());
    return out;
  }

  std::optional<config::RobotConfig> cable_;
  std::optional<config::SerialRobotConfig> serial_;
  RobotTree tree_;
  std::optional<bench::MujocoModel> engine_;
};

double angle_between(const Quat& a, const Quat& b) { return norm(rotation_vector(multiply(conjugate(a), b))); }

class EveryShippedArm : public testing::TestWithParam<std::string> {};

TEST_P(EveryShippedArm, HasTipAndCablesInMujocoWhereTheCoreHasThem) {
  Arm arm(GetParam());
  ASSERT_GE(arm.model().nkey, 3);
  ASSERT_EQ(static_cast<std::size_t>(arm.model().ntendon), arm.tree().cables.size());
  for (int key = 0; key < arm.model().nkey; ++key) {
    arm.load_key(key);
    const std::vector<double>& angle_rad = arm.pose_of_key(key).theta_rad;
    const Pose tip = arm.tip(), wanted = arm.tip_of_core(angle_rad);
    EXPECT_LT(norm(subtract(tip.position_m, wanted.position_m)), kEqual) << "key " << key;
    EXPECT_LT(angle_between(tip.quaternion, wanted.quaternion), kEqual) << "key " << key;
    const std::vector<double> cable_m = arm.cables_of_core_m(angle_rad);
    ASSERT_EQ(static_cast<std::size_t>(arm.model().ntendon), cable_m.size());
    for (std::size_t c = 0; c < cable_m.size(); ++c)
      EXPECT_NEAR(arm.data().ten_length[c], cable_m[c], kEqual) << "key " << key << " cable " << c;
  }
}

TEST_P(EveryShippedArm, WeighsInMujocoWhatTheTableSays) {
  Arm arm(GetParam());
  EXPECT_NEAR(mj_getTotalmass(&arm.model()), arm.mass_of_table_kg(), 1e-9 * arm.mass_of_table_kg());
}

// Cables stretch and joints give by what the key's commands take into account: nothing moves but by rounding and by how
// softly MuJoCo couples joints.
TEST_P(EveryShippedArm, StaysInItsNamedPosesWithTheCommandsOfTheKeys) {
  Arm arm(GetParam());
  for (int key = 0; key < arm.model().nkey; ++key) {
    arm.load_key(key);
    const Pose before = arm.tip();
    for (int i = 0; i < 100; ++i) arm.step();
    EXPECT_LT(norm(subtract(arm.tip().position_m, before.position_m)), 1e-4) << "key " << key;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryShippedArm, testing::ValuesIn(shipped("robots")),
                         [](const auto& name) { return name.param; });

TEST(Scene, EveryShippedSceneLoadsInMujocoAroundAnArm) {
  for (const std::string& name : shipped("scenes")) {
    const auto shapes = shapes_of(config::parse_scene(config::good_table("scene", name).dump(), name));
    Arm alone("zhu2022"), arm("zhu2022", shapes);
    EXPECT_EQ(static_cast<std::size_t>(arm.model().ngeom - alone.model().ngeom), shapes.size()) << name;
  }
}

}  // namespace
}  // namespace liana::description
