#include "hil/serial/joint_chain.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "hil/math/principal.hpp"

namespace liana::bench {

namespace {

void write_sphere(std::ostream& out, const char* pos, double radius_m, double mass_kg) {
  out << "<geom type='sphere' pos='" << pos << "' size='" << radius_m << "' mass='" << mass_kg << "'/>";
}

// A body's inertia where `frame` is its frame. MuJoCo would diagonalise a full tensor itself, to eight digits.
void write_inertia(std::ostream& out, const BodyConfig& body, const Pose& frame) {
  const auto& I = body.inertia_kgm2;
  const PrincipalAxes axes = principal_axes({{{I[0], I[3], I[4]}, {I[3], I[1], I[5]}, {I[4], I[5], I[2]}}});
  const Vec3 center = frame.position_m + rotate(frame.attitude, body.center_m);
  const Quat q = frame.attitude * axes.attitude;
  out << "<inertial mass='" << body.mass_kg << "' pos='" << center.x << ' ' << center.y << ' ' << center.z << "' quat='"
      << q.w << ' ' << q.x << ' ' << q.y << ' ' << q.z << "' diaginertia='" << axes.moment[0] << ' ' << axes.moment[1]
      << ' ' << axes.moment[2] << "'/>";
}

// From the frame that a joint turns to the one at the link's end.
Pose link_end(const JointConfig& joint) {
  return {{joint.a_m, 0.0, joint.d_m}, {std::cos(0.5 * joint.alpha_rad), std::sin(0.5 * joint.alpha_rad), 0.0, 0.0}};
}

// Joint i turns a body about its z axis; the next body sits at the end of the link.
void write_joint(std::ostream& out, const SerialRobotConfig& robot, std::size_t i) {
  const JointConfig& joint = robot.joints[i];
  out << "<joint type='hinge' axis='0 0 1' armature='" << robot.rotor_inertia_kgm2 << "'/>";
  if (!robot.links.empty()) return write_inertia(out, robot.links[i], link_end(joint));
  write_sphere(out, "0 0 0", robot.module_radius_m, robot.module_kg);
  if (joint.a_m == 0.0) return;
  out << "<geom type='cylinder' fromto='0 0 " << joint.d_m << ' ' << joint.a_m << " 0 " << joint.d_m << "' size='"
      << robot.boom_radius_m << "' mass='" << robot.boom_kg << "'/>";
}

void open_body(std::ostream& out, const std::string& name, const Pose& at) {
  const Vec3& p = at.position_m;
  const Quat& q = at.attitude;
  out << "<body name='" << name << "' pos='" << p.x << ' ' << p.y << ' ' << p.z << "' quat='" << q.w << ' ' << q.x
      << ' ' << q.y << ' ' << q.z << "'>";
}

}  // namespace

std::string make_serial_mjcf(const SerialRobotConfig& robot) {
  std::ostringstream out;
  out << std::setprecision(17);
  out << "<mujoco><compiler angle='radian'/><option gravity='0 0 0'/><default><geom contype='0' conaffinity='0'/>"
         "</default><worldbody>\n";
  JointConfig before;  // the base
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    open_body(out, "link" + std::to_string(i + 1), link_end(before));
    write_joint(out, robot, i);
    out << '\n';
    before = robot.joints[i];
  }
  open_body(out, "tip", link_end(before));
  if (robot.links.empty()) write_sphere(out, "0 0 0", robot.module_radius_m, robot.end_effector_kg);
  for (std::size_t i = 0; i <= robot.joints.size(); ++i) out << "</body>";
  out << "\n</worldbody></mujoco>\n";
  return out.str();
}

struct JointChain::Engine {
  mjModel* model = nullptr;
  mjData* data = nullptr;
  int tip_body = 0;

  explicit Engine(const std::string& xml) {
    const auto vfs = std::make_unique<mjVFS>();
    mj_defaultVFS(vfs.get());
    mj_makeEmptyFileVFS(vfs.get(), "arm.xml", static_cast<int>(xml.size()));
    std::memcpy(vfs->filedata[0], xml.data(), xml.size());
    char error[500] = "";
    model = mj_loadXML("arm.xml", vfs.get(), error, sizeof error);
    mj_deleteVFS(vfs.get());
    if (model == nullptr)
      throw std::runtime_error(std::string("physics: MuJoCo refuses the model of the robot: ") + error);
    data = mj_makeData(model);
    tip_body = mj_name2id(model, mjOBJ_BODY, "tip");
  }
  ~Engine() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
};

JointChain::JointChain(const SerialRobotConfig& robot) : engine_(std::make_unique<Engine>(make_serial_mjcf(robot))) {
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
