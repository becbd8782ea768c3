#include "tests/benchmarks/worst_cases.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>

#include "tests/bits/what_ifs.hpp"

namespace liana::worst {

using namespace cable;
namespace {

constexpr std::int32_t kEnablingTicks = 1060;
constexpr std::int32_t kRequestAt = 60;  // when the estimate has stood still
constexpr std::size_t kActs = 2, kFaults = 2;
constexpr double kFurther_m = 0.002;  // of a hand that moves on with every command

// Reads genes one after the other, each as what it is needed for.
class Genes {
 public:
  explicit Genes(const Case& one) : left_(one) {}

  std::uint8_t byte() {
    const std::uint8_t gene = left_.front();
    left_ = left_.subspan(1);
    return gene;
  }
  // -1 to 1, with 0 and both ends among them.
  double sign() { return std::max(-1.0, (byte() - 128.0) / 127.0); }
  double share() { return byte() / 255.0; }
  Vec3 vector(double range) {
    const double x = sign(), y = sign(), z = sign();
    return {range * x, range * y, range * z};
  }
  // 0, or 1e-6 to 1e6.
  double weight() {
    const double exponent = sign();
    return exponent == -1.0 ? 0.0 : std::pow(10.0, 6.0 * exponent);
  }
  template <std::size_t N>
  std::array<std::uint8_t, N> bytes() {
    std::array<std::uint8_t, N> out{};
    for (std::uint8_t& gene : out) gene = byte();
    return out;
  }

 private:
  std::span<const std::uint8_t> left_;
};

enum class Kind : std::uint8_t { kTip, kMovingTip, kShape, kMovingShape, kJoint, kHold, kStop, kNothing };

struct NodeGenes {
  std::int32_t node;
  Vec3 off_m;
  double weight, threshold_m;
};

struct ClearGenes {
  Vec3 off_m;
  double distance_m, weight;
};

// One command, and how often it is repeated.
struct Act {
  Kind kind;
  std::int32_t ticks, every;
  Vec3 move_m, turn_rad;
  std::uint32_t held_mask;
  double held_share, speed_share;
  std::uint64_t life_ticks;
  cable::ThetaVector joint_share{};
  std::array<NodeGenes, cable::kMaxNodeTargets> node{};
  std::array<ClearGenes, cable::kMaxKeepClear> clear{};
};

Act act_of(Genes& genes) {
  Act act{};
  act.kind = static_cast<Kind>(genes.byte() / 32);
  act.ticks = 1 + genes.byte();
  const std::uint8_t every = genes.byte();
  act.every = every >= 128 ? 1 << 20 : 1 + every % 16;
  act.move_m = genes.vector(0.5);
  act.turn_rad = genes.vector(1.0);
  const std::uint32_t low = genes.byte(), high = genes.byte(), some = genes.byte();
  act.held_mask = some < 100 ? 0 : (some < 160 ? 0x300 : low | high % 4 << 8);
  act.held_share = genes.sign();
  act.speed_share = std::max(0.01, genes.share());
  const std::uint8_t life = genes.byte();
  act.life_ticks = life >= 128 ? kForever : 1 + 4 * life;
  Genes joints = genes;  // joint motion has no shape: its angles are in the same place
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) act.joint_share[k] = joints.sign();
  for (NodeGenes& node : act.node) {
    node.node = genes.byte() % 6;
    node.off_m = genes.vector(1.0);
    node.weight = genes.weight();
    node.threshold_m = 0.5 * std::max(0.0, genes.sign());
  }
  for (ClearGenes& clear : act.clear) {
    clear.off_m = genes.vector(1.0);
    clear.distance_m = 4.0 * genes.share();
    clear.weight = genes.weight();
  }
  return act;
}

bool has_shape(Kind kind) { return kind == Kind::kShape || kind == Kind::kMovingShape; }

CommandKind command_of(Kind kind) {
  switch (kind) {
    case Kind::kJoint:
      return CommandKind::kJoint;
    case Kind::kHold:
      return CommandKind::kHold;
    case Kind::kStop:
      return CommandKind::kStop;
    case Kind::kNothing:
      return CommandKind::kNone;
    default:
      return CommandKind::kTip;
  }
}

// What an act asks of an arm that stands as `rig` says.
cable::Setpoint setpoint_of(const Act& act, const Rig& rig) {
  cable::Setpoint setpoint = rig.tip_by(act.move_m);
  setpoint.kind = command_of(act.kind);
  setpoint.tip_in_base.quaternion = normalize(multiply(quaternion_of(act.turn_rad), setpoint.tip_in_base.quaternion));
  setpoint.tip_speed_m_s *= act.speed_share;
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
    const double limit = rig.robot.segment[k / 2].theta_limit_rad;
    setpoint.joint_rad[k] = limit * act.joint_share[k];
    setpoint.held_rad[k] = limit * act.held_share;
  }
  setpoint.held_mask = act.held_mask;
  if (!has_shape(act.kind)) return setpoint;
  const auto node_m = [&](std::int32_t node) {
    return rig.out.node_command_m[static_cast<std::size_t>(std::max(node, 1) - 1)];
  };
  for (std::size_t i = 0; i < act.node.size(); ++i) {
    const NodeGenes& from = act.node[i];
    setpoint.node[i] = {from.node, add(node_m(from.node), from.off_m), from.weight, from.threshold_m};
  }
  for (std::size_t i = 0; i < act.clear.size(); ++i) {
    const ClearGenes& from = act.clear[i];
    setpoint.clear[i] = {add(node_m(static_cast<std::int32_t>(i) + 1), from.off_m), from.distance_m, from.weight};
  }
  return setpoint;
}

struct FaultGenes {
  std::uint8_t kind, at, drive;
};

struct NoiseGenes {
  std::uint8_t torque, position, seed;
};

struct RequestGenes {
  std::uint8_t kind, at;
};

// Everything a case says.
struct Story {
  cable::ThetaVector start_rad{};
  std::array<Act, kActs> act{};
  std::array<FaultGenes, kFaults> fault{};
  NoiseGenes noise{};
  RequestGenes request{};
};

Story story_of(const Case& one) {
  Genes genes(one);
  Story story;
  const double range = genes.share();
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) story.start_rad[k] = range * 20.0 * kDegree * genes.sign();
  for (Act& act : story.act) act = act_of(genes);
  for (FaultGenes& fault : story.fault) fault = {genes.byte(), genes.byte(), genes.byte()};
  story.noise = {genes.byte(), genes.byte(), genes.byte()};
  story.request = {genes.byte(), genes.byte()};
  return story;
}

// Half of the kinds are no fault.
void plant(const FaultGenes& fault, std::int32_t age, cable::Inputs& inputs) {
  const auto all = bits::what_ifs_enabled<cable::CableArm>();
  const std::size_t kind = fault.kind;
  if (kind >= all.size() || age < fault.at) return;
  const auto since = static_cast<std::uint32_t>(age - fault.at);
  if (since < all[kind].ticks) all[kind].change(inputs, since, fault.drive % zhu2022::kCables);
}

// The first kinds are none at all.
void scatter(const NoiseGenes& noise, zhu2022::Random& random, cable::Inputs& inputs) {
  constexpr std::uint8_t kLeast = 128;
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    DriveFeedback& drive = inputs.drive[c];
    if (noise.torque > kLeast)
      drive.torque_permille = narrow<std::int16_t>(
          to_counts(drive.torque_permille + random.uniform(-1.0, 1.0) * (noise.torque - kLeast)).value);
    if (noise.position > kLeast)
      drive.position_counts += to_counts(random.uniform(-1.0, 1.0) * (noise.position - kLeast)).value;
  }
}

}  // namespace

Case random_case(zhu2022::Random& random) {
  constexpr std::array<std::uint8_t, 6> kSpecial{0, 64, 128, 192, 254, 255};
  Case one{};
  for (std::uint8_t& gene : one) {
    const auto special = static_cast<std::size_t>(random.uniform(0.0, 2.5 * kSpecial.size()));
    gene = special < kSpecial.size() ? kSpecial[special] : static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
  }
  return one;
}

Case mutated(const Case& from, const Case& other, zhu2022::Random& random) {
  const auto index = [&] { return static_cast<std::size_t>(random.uniform(0.0, kGenes)); };
  Case one = from;
  if (random.uniform(0.0, 1.0) < 0.2) {
    const std::size_t a = index(), b = index();
    std::copy(other.begin() + static_cast<std::ptrdiff_t>(std::min(a, b)),
              other.begin() + static_cast<std::ptrdiff_t>(std::max(a, b)),
              one.begin() + static_cast<std::ptrdiff_t>(std::min(a, b)));
  }
  const Case fresh = random_case(random);
  const auto changes = static_cast<std::int32_t>(random.uniform(1.0, 6.0));
  for (std::int32_t i = 0; i < changes; ++i) {
    const std::size_t at = index();
    const auto nearby = static_cast<std::uint8_t>(one[at] + static_cast<std::int32_t>(random.uniform(-8.0, 9.0)));
    one[at] = random.uniform(0.0, 1.0) < 0.5 ? nearby : fresh[at];
  }
  return one;
}

std::string text_of(const Case& one) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t gene : one) text += {kDigits[gene / 16], kDigits[gene % 16]};
  return text;
}

std::vector<Case> read_cases(std::istream& lines) {
  std::vector<Case> cases;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    if (line.size() != 2 * kGenes || line.find_first_not_of("0123456789abcdef") != std::string::npos) {
      throw std::runtime_error("cases: line " + std::to_string(number) + " is not " + std::to_string(2 * kGenes) +
                               " hexadecimal digits");
    }
    Case one{};
    for (std::size_t i = 0; i < kGenes; ++i)
      one[i] = static_cast<std::uint8_t>(std::stoul(line.substr(2 * i, 2), nullptr, 16));
    cases.push_back(one);
  }
  return cases;
}

Rig started(const Case& one, const Tick& tick) {
  Rig rig(story_of(one).start_rad);
  for (std::int32_t i = 0; i < kEnablingTicks; ++i) {
    cable::Inputs inputs = rig.drives.inputs(rig.now++);
    if (i == kRequestAt) inputs.request = Request::kEnable;
    rig.out = tick(rig.controller, inputs);
    rig.drives.act(rig.out);
  }
  return rig;
}

void play(const Case& one, Rig rig, const Tick& tick) {
  const Story story = story_of(one);
  zhu2022::Random random(story.noise.seed);
  std::int32_t age = 0;
  for (const Act& act : story.act) {
    cable::Setpoint setpoint = setpoint_of(act, rig);
    const bool moves = act.kind == Kind::kMovingTip || act.kind == Kind::kMovingShape;
    for (std::int32_t i = 0; i < act.ticks; ++i, ++age) {
      cable::Inputs inputs = rig.drives.inputs(rig.now++);
      if (i % act.every == 0) inputs.telecommand = rig.release(setpoint, act.life_ticks);
      if (moves) setpoint.tip_in_base.position_m = add(setpoint.tip_in_base.position_m, scale(act.move_m, kFurther_m));
      if (age == story.request.at && story.request.kind < 5) inputs.request = static_cast<Request>(story.request.kind);
      scatter(story.noise, random, inputs);
      for (const FaultGenes& fault : story.fault) plant(fault, age, inputs);
      rig.out = tick(rig.controller, inputs);
      rig.drives.act(rig.out);
    }
  }
}

}  // namespace liana::worst
