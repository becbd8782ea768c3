#include "hil/arm/chain.hpp"

#include <array>

#include "hil/arm/mjcf.hpp"
#include "hil/arm/mujoco_model.hpp"

namespace liana::bench {

struct Chain::Engine : MujocoModel {
  using MujocoModel::MujocoModel;
  const int rod_geom = mj_name2id(model, mjOBJ_GEOM, "rod");
};

namespace {

Vec3 row_of(const mjtNum* values, std::size_t i) { return {values[3 * i], values[3 * i + 1], values[3 * i + 2]}; }

using Motion = std::array<double, 6>;  // rotation, then translation

// Of a body with inertia `i` (MuJoCo's ten numbers) that moves as `v`. Sums in MuJoCo's order, as below: same bits.
Motion momentum_of(const mjtNum* i, const mjtNum* v) {
  return {i[0] * v[0] + i[3] * v[1] + i[4] * v[2] - i[8] * v[4] + i[7] * v[5],
          i[3] * v[0] + i[1] * v[1] + i[5] * v[2] + i[8] * v[3] - i[6] * v[5],
          i[4] * v[0] + i[5] * v[1] + i[2] * v[2] - i[7] * v[3] + i[6] * v[4],
          i[8] * v[1] - i[7] * v[2] + i[9] * v[3],
          i[6] * v[2] - i[8] * v[0] + i[9] * v[4],
          i[7] * v[0] - i[6] * v[1] + i[9] * v[5]};
}

double dot(const mjtNum* a, const Motion& b) {
  return ((a[0] * b[0] + a[2] * b[2]) + (a[1] * b[1] + a[3] * b[3])) + (a[4] * b[4] + a[5] * b[5]);
}

}  // namespace

Chain::Chain(const RobotConfig& robot, const SceneConfig& scene, bool with_tendons)
    : engine_(std::make_unique<Engine>(make_mjcf(robot, scene, with_tendons))), thetas_(robot.theta_count()) {
  if (robot.base) {
    base_joints_ = kBaseDrives;
    first_body_ = 2;  // the carriage is 1
    theta_of_hinge_ = {0, 1};
    share_of_hinge_ = {robot.base->slide_m_per_rad, 1.0};
    spring_of_hinge_.resize(kBaseDrives);
  }
  for (std::size_t s = 0; s < robot.segments.size(); ++s) {
    for (int i = 0; i < robot.segments[s].modules; ++i, ++links_) {
      const std::size_t first = i % 2 == 0 ? 0 : 1;
      theta_of_hinge_.push_back(2 * s + first);
      theta_of_hinge_.push_back(2 * s + 1 - first);
      const SegmentConfig& segment = robot.segments[s];
      spring_of_hinge_.push_back({segment.joint_stiffness_Nm_rad, segment.joint_rest_rad[first]});
      spring_of_hinge_.push_back({segment.joint_stiffness_Nm_rad, segment.joint_rest_rad[1 - first]});
    }
  }
  share_of_hinge_.resize(theta_of_hinge_.size(), 1.0);
  tip_offset_m_ = robot.segments.back().module_length_m;
  place(Theta{});
}

Chain::~Chain() = default;

void Chain::set_gravity(const Vec3& gravity_m_s2) {
  engine_->model->opt.gravity[0] = gravity_m_s2.x;
  engine_->model->opt.gravity[1] = gravity_m_s2.y;
  engine_->model->opt.gravity[2] = gravity_m_s2.z;
}

void Chain::set_linkage(const Linkage& linkage) {
  for (std::size_t i = base_joints_; i < theta_of_hinge_.size(); ++i) {
    const bool pitch = theta_of_hinge_[i] % 2 == 0;
    const std::size_t link = (i - base_joints_) / 2;
    share_of_hinge_[i] = linkage.empty() ? 1.0 : pitch ? linkage[link].pitch : linkage[link].yaw;
  }
}

void Chain::place(const Theta& theta_rad) {
  for (std::size_t i = 0; i < theta_of_hinge_.size(); ++i)
    engine_->data->qpos[i] = share_of_hinge_[i] * theta_rad[theta_of_hinge_[i]];
  mj_kinematics(engine_->model, engine_->data);
  mj_comPos(engine_->model, engine_->data);
}

// As mj_crb, whose full matrix nobody needs: each of its terms goes to the angles that its hinges belong to.
void Chain::inertia(ThetaMatrix& mass) {
  const mjModel* model = engine_->model;
  mjData* data = engine_->data;
  mju_copy(data->crb, data->cinert, 10 * model->nbody);
  for (int i = model->nbody - 1; i > 1; --i)
    mju_addTo(data->crb + 10 * model->body_parentid[i], data->crb + 10 * i, 10);
  mass = {};
  for (std::size_t i = 0; i < theta_of_hinge_.size(); ++i) {
    const mjtNum* axes = data->cdof + 6 * i;
    const Motion momentum = momentum_of(data->crb + 10 * model->dof_bodyid[i], axes);
    Theta& to = mass[theta_of_hinge_[i]];
    const double share = share_of_hinge_[i];
    const double own = model->dof_armature[i] + dot(axes, momentum);
    // The diagonal must count once when the transpose is added.
    to[theta_of_hinge_[i]] += share * share * own;
    for (std::size_t j = i; j-- > 0;)
      to[theta_of_hinge_[j]] += share * share_of_hinge_[j] * dot(data->cdof + 6 * j, momentum);
    to[theta_of_hinge_[i]] -= 0.5 * share * share * own;
  }
  for (std::size_t a = 0; a < thetas_; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      const double sum = mass[a][b] + mass[b][a];
      mass[a][b] = sum;
      mass[b][a] = sum;
    }
  }
}

void Chain::bias(const Theta& rate_rad_s, Theta& force) {
  mjData* data = engine_->data;
  for (std::size_t i = 0; i < theta_of_hinge_.size(); ++i)
    data->qvel[i] = share_of_hinge_[i] * rate_rad_s[theta_of_hinge_[i]];
  mj_comVel(engine_->model, data);
  mj_rne(engine_->model, data, 0, data->qfrc_bias);
  force = {};
  for (std::size_t i = 0; i < theta_of_hinge_.size(); ++i)
    force[theta_of_hinge_[i]] +=
        share_of_hinge_[i] *
        (data->qfrc_bias[i] + spring_of_hinge_[i].stiffness_Nm_rad * (data->qpos[i] - spring_of_hinge_[i].rest_rad));
}

void Chain::remove_rod() { engine_->model->geom_conaffinity[engine_->rod_geom] = 0; }

const std::vector<Contact>& Chain::contacts() {
  const mjModel* model = engine_->model;
  mj_collision(model, engine_->data);
  contacts_.clear();
  for (int i = 0; i < engine_->data->ncon; ++i) {
    const mjContact& found = engine_->data->contact[i];
    if (found.dist >= 0.0) continue;
    const int body1 = model->geom_bodyid[found.geom1];
    const int body2 = model->geom_bodyid[found.geom2];
    // MuJoCo's normal points from geom 1 to geom 2; the world is body 0.
    const double sign = body1 == 0 ? 1.0 : -1.0;
    Contact contact;
    contact.link = static_cast<std::size_t>(body1 == 0 ? body2 : body1) - first_body_;
    contact.point_m = row_of(found.pos, 0);
    contact.normal = sign * row_of(found.frame, 0);
    contact.depth_m = -found.dist;
    contact.rod = found.geom1 == engine_->rod_geom || found.geom2 == engine_->rod_geom;
    contacts_.push_back(contact);
  }
  return contacts_;
}

Vec3 Chain::joint_center_m(std::size_t link) const {
  return link < links_ ? row_of(engine_->data->xpos, link + first_body_) : tip().position_m;
}

Pose Chain::tip() const {
  const std::size_t last = links_ + first_body_ - 1;
  const mjtNum* q = engine_->data->xquat + 4 * last;
  const Quat attitude{q[0], q[1], q[2], q[3]};
  return {row_of(engine_->data->xpos, last) + rotate(attitude, {tip_offset_m_, 0.0, 0.0}), attitude};
}

void Chain::point_jacobian(std::size_t link, const Vec3& point_m, PointJacobian& jacobian) const {
  jacobian = {};
  for (std::size_t i = 0; i < base_joints_ + 2 * (link + 1); ++i) {
    const Vec3 axis = row_of(engine_->data->xaxis, i);
    const bool slides = i == 0 && base_joints_ != 0;
    const Vec3 column = share_of_hinge_[i] * (slides ? axis : cross(axis, point_m - row_of(engine_->data->xanchor, i)));
    const std::size_t t = theta_of_hinge_[i];
    jacobian[0][t] += column.x;
    jacobian[1][t] += column.y;
    jacobian[2][t] += column.z;
  }
}

std::uint64_t Chain::warnings() const {
  std::uint64_t count = 0;
  for (const auto& warning : engine_->data->warning) count += static_cast<std::uint64_t>(warning.number);
  return count;
}

std::vector<double> Chain::tendon_lengths_m() {
  mj_tendon(engine_->model, engine_->data);
  return {engine_->data->ten_length, engine_->data->ten_length + engine_->model->ntendon};
}

std::vector<double> Chain::full_inertia() {
  mj_crb(engine_->model, engine_->data);
  std::vector<double> full(static_cast<std::size_t>(engine_->model->nv * engine_->model->nv));
  mj_fullM(engine_->model, full.data(), engine_->data->qM);
  return full;
}

}  // namespace liana::bench
