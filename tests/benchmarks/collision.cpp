// FCL and libccd beside our closed form: every link of an arm, a capsule, against boxes; no broad phase anywhere.
//
// FCL's distance is the same question as ours. The others only say whether two bodies touch, which is less.
#include <ccd/ccd.h>
#include <fcl/fcl.h>

#include <cmath>
#include <cstdio>
#include <exception>

#include "host/model/clearance/clearance.hpp"
#include "tests/benchmarks/meter.hpp"
#include "tests/benchmarks/problems.hpp"

namespace liana::bench {
namespace {

constexpr double kLinkRadius_m = 0.04;
constexpr std::size_t kBoxes = 6;
constexpr double kPeerError_m = 2e-3;  // FCL's distance comes from an iteration, and it knows no depth

struct Scenario {
  std::vector<clearance::Capsule> links;
  std::vector<config::SceneBox> boxes;
};

// An arm at a random pose among boxes of 0.1 to 0.6 m.
Scenario scenario(const cable::RobotParams& robot, const cable::ThetaVector& theta, zhu2022::Random& random) {
  Scenario out;
  const cable::LinkPoints points = link_points(robot, theta);
  for (std::int32_t link = 0; link + 1 < points.count; ++link)
    out.links.push_back(clearance::link_capsule(points.axis(), link, kLinkRadius_m));
  while (out.boxes.size() < kBoxes) {
    const Quat turn = quaternion_of(random.vector(1.5));
    const Vec3 from_middle = random.vector(1.5), half = random.vector(0.125);
    out.boxes.push_back({"box",
                         add(from_middle, {2.5, 0.0, 0.0}),
                         add(half, {0.175, 0.175, 0.175}),
                         {rotate(turn, {1, 0, 0}), rotate(turn, {0, 1, 0}), rotate(turn, {0, 0, 1})}});
  }
  return out;
}

// Calls `query(link, box)` for every pair and adds up what it returns.
template <class Link, class Box, class Query>
double sum_over_pairs(const std::vector<Link>& links, const std::vector<Box>& boxes, Query&& query) {
  double sum = 0.0;
  for (const Link& link : links) {
    for (const Box& box : boxes) sum += query(link, box);
  }
  return sum;
}

// --- FCL ---

struct FclScenario {
  std::vector<fcl::CollisionObjectd> links, boxes;
};

// A capsule of FCL lies along z around its middle.
fcl::CollisionObjectd fcl_link(const clearance::Capsule& link) {
  const Vec3 axis = subtract(link.to_m, link.from_m), middle = scale(add(link.from_m, link.to_m), 0.5);
  const Eigen::Vector3d along(axis[0], axis[1], axis[2]);
  fcl::Transform3d at = fcl::Transform3d::Identity();
  at.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along).toRotationMatrix();
  at.translation() = Eigen::Vector3d(middle[0], middle[1], middle[2]);
  return {std::make_shared<fcl::Capsuled>(link.radius_m, along.norm()), at};
}

fcl::CollisionObjectd fcl_box(const config::SceneBox& box) {
  fcl::Transform3d at = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    const Vec3& axis = box.rotation[static_cast<std::size_t>(i)];
    at.linear().col(i) = Eigen::Vector3d(axis[0], axis[1], axis[2]);
  }
  at.translation() = Eigen::Vector3d(box.center_m[0], box.center_m[1], box.center_m[2]);
  const Vec3& half = box.half_extent_m;
  return {std::make_shared<fcl::Boxd>(2.0 * half[0], 2.0 * half[1], 2.0 * half[2]), at};
}

FclScenario fcl_scenario(const Scenario& from) {
  FclScenario out;
  for (const clearance::Capsule& link : from.links) out.links.push_back(fcl_link(link));
  for (const config::SceneBox& box : from.boxes) out.boxes.push_back(fcl_box(box));
  return out;
}

double fcl_distance(const fcl::CollisionObjectd& link, const fcl::CollisionObjectd& box) {
  fcl::DistanceResultd result;
  return fcl::distance(&link, &box, fcl::DistanceRequestd(), result);
}

bool fcl_touch(const fcl::CollisionObjectd& link, const fcl::CollisionObjectd& box) {
  fcl::CollisionResultd result;
  return fcl::collide(&link, &box, fcl::CollisionRequestd(), result) > 0;
}

// --- libccd: bodies by their furthest point in a direction ---

void link_support(const void* body, const ccd_vec3_t* direction, ccd_vec3_t* furthest) {
  const clearance::Capsule& link = *static_cast<const clearance::Capsule*>(body);
  const Vec3 d{direction->v[0], direction->v[1], direction->v[2]};
  const Vec3& end = dot(d, subtract(link.to_m, link.from_m)) > 0.0 ? link.to_m : link.from_m;
  const Vec3 p = add(end, scale(d, link.radius_m / std::sqrt(dot(d, d))));
  ccdVec3Set(furthest, p[0], p[1], p[2]);
}

void box_support(const void* body, const ccd_vec3_t* direction, ccd_vec3_t* furthest) {
  const config::SceneBox& box = *static_cast<const config::SceneBox*>(body);
  const Vec3 d{direction->v[0], direction->v[1], direction->v[2]};
  Vec3 p = box.center_m;
  for (std::size_t i = 0; i < 3; ++i) {
    const double half = box.half_extent_m[i];
    p = add(p, scale(box.rotation[i], dot(d, box.rotation[i]) > 0.0 ? half : -half));
  }
  ccdVec3Set(furthest, p[0], p[1], p[2]);
}

void link_center(const void* body, ccd_vec3_t* center) {
  const clearance::Capsule& link = *static_cast<const clearance::Capsule*>(body);
  const Vec3 p = scale(add(link.from_m, link.to_m), 0.5);
  ccdVec3Set(center, p[0], p[1], p[2]);
}

void box_center(const void* body, ccd_vec3_t* center) {
  const Vec3& p = static_cast<const config::SceneBox*>(body)->center_m;
  ccdVec3Set(center, p[0], p[1], p[2]);
}

ccd_t ccd_settings() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = link_support;
  ccd.support2 = box_support;
  ccd.center1 = link_center;
  ccd.center2 = box_center;
  ccd.max_iterations = 100;
  ccd.mpr_tolerance = 1e-6;
  return ccd;
}

// --- all together ---

// FCL must give our distance where the bodies are apart; all must agree on whether they touch, but for a hair.
void compare(const Scenario& ours, const FclScenario& fcl, const ccd_t& ccd) {
  for (std::size_t l = 0; l < ours.links.size(); ++l) {
    for (std::size_t b = 0; b < kBoxes; ++b) {
      const double distance_m = clearance::clearance(ours.links[l], ours.boxes[b]).distance_m;
      if (distance_m > kPeerError_m)
        require_agreement("distance of FCL", std::fabs(fcl_distance(fcl.links[l], fcl.boxes[b]) - distance_m),
                          kPeerError_m);
      if (std::fabs(distance_m) < kPeerError_m) continue;
      const bool touch = distance_m < 0.0;
      const bool same = fcl_touch(fcl.links[l], fcl.boxes[b]) == touch &&
                        (ccdMPRIntersect(&ours.links[l], &ours.boxes[b], &ccd) != 0) == touch &&
                        (ccdGJKIntersect(&ours.links[l], &ours.boxes[b], &ccd) != 0) == touch;
      require_agreement("touching of FCL or libccd", same ? 0.0 : 1.0);
    }
  }
}

void measure(Meter& meter, const cable::RobotParams& robot) {
  zhu2022::Random random(4);
  const ccd_t ccd = ccd_settings();
  std::vector<Scenario> ours;
  std::vector<FclScenario> fcl;
  for (const cable::ThetaVector& theta : random_poses(robot, kSlowCalls)) {
    ours.push_back(scenario(robot, theta, random));
    fcl.push_back(fcl_scenario(ours.back()));
    compare(ours.back(), fcl.back(), ccd);
  }
  const std::size_t pairs = ours[0].links.size() * kBoxes;
  const auto count = [&](const std::string& version, auto&& sum_of_scenario) {
    meter.each("clearance", version, kSlowCalls, sum_of_scenario);
    meter.parts("clearance", version, pairs);
  };
  const auto touch_of = [&](auto&& intersect) {
    return [&ours, &ccd, intersect](std::size_t i) {
      return sum_over_pairs(ours[i].links, ours[i].boxes,
                            [&](const clearance::Capsule& link, const config::SceneBox& box) {
                              return static_cast<double>(intersect(&link, &box, &ccd));
                            });
    };
  };
  count("ours", [&](std::size_t i) {
    return sum_over_pairs(ours[i].links, ours[i].boxes,
                          [](const clearance::Capsule& link, const config::SceneBox& box) {
                            return clearance::clearance(link, box).distance_m;
                          });
  });
  count("fcl", [&](std::size_t i) { return sum_over_pairs(fcl[i].links, fcl[i].boxes, fcl_distance); });
  count("fcl_collide", [&](std::size_t i) { return sum_over_pairs(fcl[i].links, fcl[i].boxes, fcl_touch); });
  count("libccd", touch_of(ccdMPRIntersect));
  count("libccd_gjk", touch_of(ccdGJKIntersect));
  meter.note("clearance", "ours", "capsule to box: signed distance, nearest points, normal");
  meter.note("clearance", "fcl", "distance without nearest points");
  meter.note("clearance", "fcl_collide", "touching or not");
  meter.note("clearance", "libccd", "MPR, touching or not");
  meter.note("clearance", "libccd_gjk", "GJK, touching or not");
}

}  // namespace
}  // namespace liana::bench

int main() try {
  liana::bench::Meter meter;
  liana::bench::measure(meter, liana::cable::zhu2022::table());
  meter.print();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
