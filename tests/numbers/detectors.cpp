// How small a fault of a cable is found, and how soon: the real core against the bench's arm, on its way from prepare
// to the panel edge.
// `--count` seeds. One cable of every segment gets every fault in a run of its own; faults that have a size grow until
// they are found.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "tests/closed_loop/arm_under_control.hpp"
#include "tests/closed_loop/fixture.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {
namespace {

using closed_loop::ArmUnderControl;
using closed_loop::Plant;

constexpr double kWay_s = 42.0;
constexpr int kBegin = 2500;  // ticks of motion before the fault; it is fastest at 5250
constexpr int kAfter = 1500;  // ticks watched after the fault was found
constexpr double kGrowth = 1.15;

// One kind of fault: what happens in tick `age` (0 = the first), and its size then.
struct Kind {
  const char* name;
  const char* unit;
  double (*act)(Plant& plant, std::size_t cable, int age, double size);
  double first_size;
  int apart;  // ticks between two sizes; 0: one size only
};

// What goes one way in one step goes back in the next, so that small ones do not add up.
double slip(Plant& plant, std::size_t cable, int step, double size_um) {
  plant.loosen(cable, 1e-6 * (step % 2 == 0 ? size_um : -size_um / kGrowth));
  return size_um;
}
double jump(Plant& plant, std::size_t cable, int step, double size_um) {
  plant.jump_encoder(cable, 1e-6 * (step % 2 == 0 ? size_um : -size_um / kGrowth));
  return size_um;
}
double scatter(Plant& plant, std::size_t cable, int, double size_N) {
  plant.scatter(cable, size_N);
  return size_N;
}
double creep(Plant& plant, std::size_t cable, int step, double) {
  constexpr double kPerTick_um = 0.4;  // 0.1 mm/s
  plant.loosen(cable, 1e-6 * kPerTick_um);
  return (step + 1) * kPerTick_um;
}
double part(Plant& plant, std::size_t cable, int, double) {
  plant.loosen(cable, 1.0);
  return 0.0;
}
double lose(Plant& plant, std::size_t cable, int, double) {
  plant.lose_reading(cable);
  return 0.0;
}

constexpr Kind kKinds[] = {{"slip", "um", slip, 5.0, 100},
                           {"encoder jump", "um", jump, 5.0, 100},
                           {"creep of 0.1 mm/s", "um", creep, 0.0, 1},
                           {"scatter", "N", scatter, 0.5, 200},
                           {"break", "", part, 0.0, 0},
                           {"reading lost", "", lose, 0.0, 0}};

struct Found {
  int number = 0, index = -1, ticks = 0;  // of the first fault; ticks since the size that was found
  double size = 0.0;
  double travel_deg = 0.0;  // largest of any angle, from a tick before the last size on
};

// A fault of one cable on the way; the core stops the arm when it is found.
class Trial {
 public:
  Trial(const Kind& kind, const closed_loop::PlantSetup& setup, std::size_t cable)
      : kind_(kind), cable_(cable), arm_(setup) {}

  Found run() {
    arm_.boot();
    const ThetaVector from = arm_.outputs().theta_command_rad, to = closed_loop::named_pose_rad("panel_edge");
    try {
      arm_.follow(
          kWay_s,
          [&](double share) {
            Setpoint setpoint;
            setpoint.kind = CommandKind::kJoint;
            const double done = closed_loop::minimum_jerk(share);
            for (std::size_t i = 0; i < from.size(); ++i) setpoint.joint_rad[i] = from[i] + done * (to[i] - from[i]);
            return setpoint;
          },
          [&](ArmUnderControl&) { look(); });
    } catch (const Seen&) {
    }
    return found_;
  }

 private:
  struct Seen {};

  void look() {
    const int age = tick_++ - kBegin;
    if (age < 0) return;
    if (found_.number == 0 && arm_.outputs().faults.count > 0) {
      const Fault& first = arm_.outputs().faults.fault[0];
      found_.number = static_cast<int>(first.number);
      found_.index = first.index;
      found_.ticks = age - since_;
    }
    if (found_.number == 0) {
      if (age == 0 || (kind_.apart > 0 && age % kind_.apart == 0)) grow(age);
      return;
    }
    found_.travel_deg =
        std::max(found_.travel_deg, closed_loop::largest_difference_deg(arm_.plant().theta_rad(), before_));
    if (age - since_ - found_.ticks > kAfter) throw Seen{};
  }

  void grow(int age) {
    before_ = arm_.plant().theta_rad();
    since_ = age;
    found_.size = kind_.act(arm_.plant(), cable_, step_, size_);
    size_ *= kGrowth;
    ++step_;
  }

  Kind kind_;
  std::size_t cable_;
  ArmUnderControl arm_;
  Found found_;
  ThetaVector before_{};
  int tick_ = 0, since_ = 0, step_ = 0;
  double size_ = kind_.first_size;
};

void measure(std::int32_t seeds) {
  const char* separator = "";
  std::printf("[");
  for (const Kind& kind : kKinds) {
    for (const char* physics : {"ideal", "nominal", "worn"}) {
      for (std::int32_t seed = 1; seed <= seeds; ++seed) {
        for (std::size_t segment = 0; segment < 5; ++segment) {
          const std::size_t cable = 3 * segment + static_cast<std::size_t>(seed) % 3;
          const Found found = Trial(kind, {physics, static_cast<std::uint64_t>(seed), true, "prepare"}, cable).run();
          std::printf(
              R"(%s{"kind":"%s","unit":"%s","physics":"%s","seed":%d,"cable":%zu,"number":%d,"index":%d,"size":%.4g,"ticks":%d,"travel_deg":%.3f})",
              separator, kind.name, kind.unit, physics, seed, cable, found.number, found.index, found.size, found.ticks,
              found.travel_deg);
          std::fflush(stdout);
          separator = ",\n ";
        }
      }
    }
  }
  std::printf("]\n");
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  const liana::numbers::Options options = liana::numbers::parse_options(argc, argv, 2);
  liana::numbers::measure(options.count);
}
