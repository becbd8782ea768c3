// Distances of host/model/clearance against an exact reference (exact_distance.hpp): `--count` pairs of a link and a
// body. Ends with exit code 1 where a distance is off by more than kAllowed_m, above the truth by more than a rounding,
// or free where the reference touches.
#include <cstdio>
#include <random>
#include <string>

#include "host/model/clearance/self_clearance.hpp"
#include "host/model/config/convex_shape.hpp"
#include "tests/numbers/exact_distance.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {
namespace {

constexpr double kAllowed_m = 1e-6;
constexpr double kRounding_m = 1e-12;

using clearance::Capsule;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}
  double number(double low, double high) {
    return low + (high - low) * double(generator_() >> 11) / 9007199254740992.0;
  }
  int whole(int low, int high) { return low + static_cast<int>(generator_() % std::uint64_t(high - low + 1)); }
  Vec3 place(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  // On a grid of 0.1 m: aligned, parallel, touching, coinciding.
  Vec3 grid() { return {0.1 * whole(-4, 4), 0.1 * whole(-4, 4), 0.1 * whole(-4, 4)}; }
  Capsule link(bool aligned) {
    const double radius_m = whole(0, 3) == 0 ? 0.0 : (aligned ? 0.1 * whole(0, 2) : number(0.0, 0.05));
    const Vec3 from = aligned ? grid() : place(0.6);
    if (whole(0, 19) == 0) return {from, from, radius_m};
    return {from, aligned ? grid() : add(from, place(whole(0, 4) == 0 ? 1e-3 : 0.3)), radius_m};
  }
  std::vector<Vec3> points(bool aligned) {
    const Vec3 at = place(0.5);
    const Vec3 size = aligned ? Vec3{} : Vec3{number(0.0, 0.3), number(0.0, 0.3), whole(0, 2) == 0 ? 1e-4 : 0.3};
    std::vector<Vec3> out(static_cast<std::size_t>(whole(4, 10)));
    for (Vec3& p : out) {
      const Vec3 in = place(1.0);
      p = aligned ? grid() : add(at, {in[0] * size[0], in[1] * size[1], in[2] * size[2]});
    }
    return out;
  }
  std::array<Vec3, 3> axes(bool aligned) {
    if (aligned) return {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}};
    const Quat q = quaternion_of(place(1.7));
    return {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1})};
  }

 private:
  std::mt19937_64 generator_;
};

// What a distance was found to be, and what it is; the latter 0 where the axes themselves touch.
struct Compared {
  double found_m;
  Real exact_m;
};

Piece piece(const Capsule& link) { return {point(link.from_m), point(link.to_m)}; }

std::vector<Point> exact_points(const std::vector<Vec3>& points) {
  std::vector<Point> out;
  for (const Vec3& p : points) out.push_back(point(p));
  return out;
}

Compared sphere(Draw& draw, bool aligned) {
  const Capsule link = draw.link(aligned);
  const config::SceneSphere body{"body", aligned ? draw.grid() : draw.place(0.5), draw.number(0.01, 0.3)};
  return {clearance::clearance(link, body).distance_m,
          point_piece(point(body.center_m), piece(link)) - body.radius_m - link.radius_m};
}

Compared box(Draw& draw, bool aligned) {
  const Capsule link = draw.link(aligned);
  config::SceneBox body{"body", draw.place(0.5), draw.place(0.3), draw.axes(aligned)};
  if (aligned) body.center_m = draw.grid(), body.half_extent_m = {0.1, 0.2, 0.1};
  std::vector<Vec3> corners;
  for (double& half : body.half_extent_m) half = std::fabs(half);
  for (int i = 0; i < 8; ++i) {
    Vec3 corner = body.center_m;
    for (std::size_t k = 0; k < 3; ++k)
      corner = add(corner, scale(body.rotation[k], (i >> k & 1 ? 1 : -1) * body.half_extent_m[k]));
    corners.push_back(corner);
  }
  return {clearance::clearance(link, body).distance_m, piece_hull(piece(link), exact_points(corners)) - link.radius_m};
}

Compared hull(Draw& draw, bool aligned) {
  const Capsule link = draw.link(aligned);
  const std::vector<Vec3> points = draw.points(aligned);
  return {clearance::clearance(link, config::hull_of("body", points)).distance_m,
          piece_hull(piece(link), exact_points(points)) - link.radius_m};
}

Compared cylinder(Draw& draw, bool aligned) {
  const Capsule link = draw.link(aligned);
  const Vec3 from = aligned ? draw.grid() : draw.place(0.5);
  const Vec3 way = aligned ? Vec3{0, 0, 0.1 * draw.whole(1, 3)} : draw.place(0.3);
  const double radius_m = aligned ? 0.1 * draw.whole(1, 3) : draw.number(0.01, 0.3);
  const Vec3 to = add(from, way);
  return {clearance::clearance(link, config::cylinder("body", from, to, radius_m)).distance_m,
          piece_cylinder(piece(link), {point(from), point(to)}, radius_m) - link.radius_m};
}

Compared capsule(Draw& draw, bool aligned) {
  const Capsule link = draw.link(aligned), body = draw.link(aligned);
  return {clearance::clearance(link, config::capsule("body", body.from_m, body.to_m, body.radius_m)).distance_m,
          piece_piece(piece(link), piece(body)) - body.radius_m - link.radius_m};
}

Compared two_links(Draw& draw, bool aligned) {
  const Capsule a = draw.link(aligned), b = draw.link(aligned);
  return {clearance::between_m(a, b), piece_piece(piece(a), piece(b)) - a.radius_m - b.radius_m};
}

struct Kind {
  const char* name;
  Compared (*compare)(Draw&, bool aligned);
};
constexpr Kind kKinds[] = {{"sphere", sphere},     {"box", box},         {"hull", hull},
                           {"cylinder", cylinder}, {"capsule", capsule}, {"two links", two_links}};

struct Outcome {
  int pairs = 0, touching = 0, free_where_touching = 0, off = 0;
  double worst_below_m = 0.0, worst_above_m = 0.0;  // of pairs that are apart
};

Outcome measure(const Kind& kind, bool aligned, int pairs, std::uint64_t seed) {
  Draw draw(seed);
  Outcome out;
  for (int i = 0; i < pairs; ++i) {
    const Compared c = kind.compare(draw, aligned);
    ++out.pairs;
    if (c.exact_m <= kRounding_m) {
      ++out.touching;
      out.free_where_touching += c.found_m <= kRounding_m ? 0 : 1;
      continue;
    }
    const double above_m = static_cast<double>(c.found_m - c.exact_m);
    out.worst_above_m = std::max(out.worst_above_m, above_m);
    out.worst_below_m = std::max(out.worst_below_m, -above_m);
    out.off += above_m >= -kAllowed_m && above_m <= kRounding_m ? 0 : 1;
  }
  return out;
}

bool run(const Options& options) {
  const int share = std::max(1, options.count / 12);
  bool good = true;
  std::uint64_t seed = 1;
  for (const Kind& kind : kKinds) {
    for (const bool aligned : {false, true}) {
      const Outcome o = measure(kind, aligned, share, seed++);
      good = good && o.off == 0 && o.free_where_touching == 0 && o.touching > 0 && o.touching < o.pairs;
      const char* format = options.json ? "%s{\"body\":\"%s\",\"aligned\":%s,\"pairs\":%d,\"touching\":%d,\"free\":%d,"
                                          "\"off\":%d,\"below_m\":%.3g,\"above_m\":%.3g}"
                                        : "%s%-9s aligned %-5s: %d pairs, %d touching, %d of them free, %d off; worst "
                                          "%.1e m below, %.1e m above\n";
      std::printf(format, !options.json ? "" : (seed == 2 ? "[" : ","), kind.name, aligned ? "true" : "false", o.pairs,
                  o.touching, o.free_where_touching, o.off, o.worst_below_m, o.worst_above_m);
    }
  }
  if (options.json) std::puts("]");
  return good;
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  return liana::numbers::run(liana::numbers::parse_options(argc, argv, 100000)) ? 0 : 1;
}
