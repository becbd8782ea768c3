#include "hil/serial/joint_chain.hpp"

#include "hil/arm/mujoco_model.hpp"
#include "hil/serial/link_axis.hpp"
#include "hil/serial/serial_mjcf.hpp"

namespace liana::bench {

struct JointChain::Engine : MujocoModel {
  using MujocoModel::MujocoModel;
  const int tip_body = mj_name2id(model, mjOBJ_BODY, "tip");
};

JointChain::JointChain(const SerialRobotConfig& robot)
    : robot_(robot), engine_(std::make_unique<Engine>(make_serial_mjcf(robot))) {
  for (const JointConfig& joint : robot.joints) offset_rad_.push_back(joint.offset_rad);
  place(std::vector<double>(robot.joints.size(), 0.0));
}

JointChain::~JointChain() = default;

void JointChain::place(const std::vector<double>& joint_rad) {
  for (std::size_t i = 0; i < offset_rad_.size(); ++i) engine_->data->qpos[i] = joint_rad[i] + offset_rad_[i];
  mj_kinematics(engine_->model, engine_->data);
  mj_comPos(engine_->model, engine_->data);
}

Pose JointChain::tip() const {
  const mjtNum* p = engine_->data->xpos + 3 * engine_->tip_body;
  const mjtNum* q = engine_->data->xquat + 4 * engine_->tip_body;
  return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
}

std::vector<Vec3> JointChain::axis_m() const { return link_axis_m(*engine_, robot_); }

std::vector<double> JointChain::torque_Nm(const std::vector<double>& rate_rad_s,
                                          const std::vector<double>& accel_rad_s2) {
  mjData* data = engine_->data;
  const std::size_t joints = offset_rad_.size();
  for (std::size_t i = 0; i < joints; ++i) {
    data->qvel[i] = rate_rad_s[i];
    data->qacc[i] = accel_rad_s2[i];
  }
  mj_comVel(engine_->model, data);
  mj_rne(engine_->model, data, 1, data->qfrc_inverse);
  std::vector<double> torque(joints);
  // MuJoCo's recursion knows the bodies only; the rotors turn with their joints.
  for (std::size_t i = 0; i < joints; ++i)
    torque[i] = data->qfrc_inverse[i] + engine_->model->dof_armature[i] * accel_rad_s2[i];
  return torque;
}

}  // namespace liana::bench
