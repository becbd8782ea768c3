// The bench's model of a serial arm in MuJoCo, asked for inverse dynamics as MuJoCo has it.
#pragma once

#include <iomanip>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "firmware_like/serial/dynamics.hpp"
#include "hil/arm/mujoco_model.hpp"
#include "hil/math/principal.hpp"
#include "hil/serial/serial_mjcf.hpp"

namespace liana::test {

class MujocoArm {
 public:
  // Without rotors; `payload` is fixed to the tip.
  MujocoArm(bench::SerialRobotConfig robot, const serial::LinkMass& payload, const Vec3& gravity_m_s2) {
    robot.rotor_inertia_kgm2 = 0.0;
    for (const auto& joint : robot.joints) offset_rad_.push_back(joint.offset_rad);
    std::string xml = bench::make_serial_mjcf(robot);
    replace(xml, "gravity='0 0 0'", "gravity='" + text(gravity_m_s2) + "'");
    const std::size_t tip = xml.find('>', xml.find("<body name='tip'"));
    const bench::PrincipalAxes axes =
        bench::principal_axes({column(payload, 0), column(payload, 1), column(payload, 2)});
    const bench::Quat& q = axes.attitude;
    std::ostringstream body;
    body << std::setprecision(17) << "<body><inertial mass='" << payload.mass_kg << "' pos='" << text(payload.center_m)
         << "' quat='" << q.w << ' ' << text({q.x, q.y, q.z}) << "' diaginertia='"
         << text({axes.moment[0], axes.moment[1], axes.moment[2]}) << "'/></body>";
    xml.insert(tip + 1, body.str());
    engine_ = std::make_unique<bench::MujocoModel>(xml);
    model_ = engine_->model;
    data_ = engine_->data;
  }

  // Less the wrench's share by the Jacobian of the tip.
  std::vector<double> torque_Nm(const serial::JointMotion& motion, const serial::Wrench& on_tip) {
    const auto joints = static_cast<std::size_t>(model_->nv);
    for (std::size_t i = 0; i < joints; ++i) {
      data_->qpos[i] = motion.joint_rad[i] + offset_rad_[i];
      data_->qvel[i] = motion.rate_rad_s[i];
      data_->qacc[i] = motion.accel_rad_s2[i];
    }
    mj_inverse(model_, data_);
    std::vector<mjtNum> linear(3 * joints), angular(3 * joints);
    mj_jacBody(model_, data_, linear.data(), angular.data(), mj_name2id(model_, mjOBJ_BODY, "tip"));
    std::vector<double> torque(joints);
    for (std::size_t i = 0; i < joints; ++i) {
      torque[i] = data_->qfrc_inverse[i];
      for (std::size_t r = 0; r < 3; ++r)
        torque[i] -= linear[r * joints + i] * on_tip.force_N[r] + angular[r * joints + i] * on_tip.torque_Nm[r];
    }
    return torque;
  }

  // At the angles of the last torque_Nm, row after row.
  std::vector<double> mass_matrix() {
    std::vector<mjtNum> full(static_cast<std::size_t>(model_->nv * model_->nv));
    mj_fullM(model_, full.data(), data_->qM);
    return full;
  }

 private:
  static std::string text(const Vec3& v) {
    std::ostringstream out;
    out << std::setprecision(17) << v[0] << ' ' << v[1] << ' ' << v[2];
    return out.str();
  }
  static bench::Vec3 column(const serial::LinkMass& body, std::size_t k) {
    Vec3 unit{};
    unit[k] = 1.0;
    const Vec3 out = serial::inertia_times(body, unit);
    return {out[0], out[1], out[2]};
  }
  static void replace(std::string& xml, const std::string& what, const std::string& by) {
    xml.replace(xml.find(what), what.size(), by);
  }

  std::unique_ptr<bench::MujocoModel> engine_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<double> offset_rad_;
};

}  // namespace liana::test
