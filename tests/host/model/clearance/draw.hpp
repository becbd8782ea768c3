// Random links, arms and obstacles for the tests of distances.
#pragma once

#include <random>
#include <vector>

#include "host/model/clearance/clearance.hpp"
#include "host/model/config/convex_shape.hpp"

namespace liana::clearance {

constexpr double kRadius_m = 0.03;  // of the arms

// Random links and obstacles of the sizes that matter: links of 0 to 0.5 m among bodies of 0.01 to 1 m.
class Draw {
 public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  Vec3 place(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  Capsule link() {
    const Vec3 from = place(0.6);
    return {from, add(from, place(0.3)), number(0.0, 0.05)};
  }
  // A row of `links` links of `length_m`, each turned against the last by a little: an arm of no particular kind.
  std::vector<Vec3> axis(int links, double length_m) {
    std::vector<Vec3> points{place(0.3)};
    Vec3 way = place(1.0);
    for (int i = 0; i < links; ++i) {
      way = add(way, scale(place(0.35), norm(way)));
      points.push_back(add(points.back(), scale(way, length_m / norm(way))));
    }
    return points;
  }
  config::SceneConfig scene(int spheres, int boxes, double size, int convex = 0) {
    config::SceneConfig out;
    for (int i = 0; i < spheres; ++i) out.spheres.push_back(sphere());
    for (int i = 0; i < boxes; ++i) out.boxes.push_back(box());
    for (config::SceneSphere& sphere : out.spheres) sphere.center_m = place(size);
    for (config::SceneBox& box : out.boxes) box.center_m = place(size);
    for (int i = 0; i < convex; ++i) out.convex.push_back(body(i, place(size)));
    return out;
  }
  // A hull, a cylinder or a capsule about a place.
  config::SceneConvex body(int kind, const Vec3& at) {
    const Vec3 from = add(at, place(0.2)), to = add(at, place(0.2));
    if (kind % 3 == 1) return config::cylinder("cylinder", from, to, number(0.01, 0.2));
    if (kind % 3 == 2) return config::capsule("capsule", from, to, number(0.01, 0.2));
    std::vector<Vec3> points;
    for (int i = 0; i < 9; ++i) points.push_back(add(at, place(0.25)));
    return config::hull_of("hull", points);
  }
  config::SceneSphere sphere() { return {"sphere", place(0.5), number(0.01, 0.5)}; }
  config::SceneBox box() {
    const Quat q = quaternion_of(place(2.0));
    return {"box",
            place(0.5),
            {number(0.01, 0.5), number(0.01, 0.5), number(0.01, 0.5)},
            {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1})}};
  }

 private:
  std::mt19937 generator_;
};

}  // namespace liana::clearance
