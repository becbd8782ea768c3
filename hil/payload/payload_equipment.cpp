#include "hil/payload/payload_equipment.hpp"

#include <nlohmann/json.hpp>

namespace liana::bench {

namespace {

constexpr double kRests_rad_s = 0.0017;  // 0.1 deg/s: a swing of the base is no motion

}  // namespace

PayloadEquipment::PayloadEquipment(const CameraConfig& camera, TorquePlant& plant, bool spread, std::uint64_t seed)
    : plant_(plant), camera_(camera, lens(), spread, seed) {}

Lens PayloadEquipment::lens() const {
  return plant_.site()->holder() == Holder::kArm ? Lens::kAdapter : Lens::kGrapple;
}

void PayloadEquipment::suffer(const CameraDefects& camera, const ToolDefects& tool) {
  camera_.suffer(camera);
  grapple_.suffer(tool);
  carrier_.suffer(tool);
}

void PayloadEquipment::look(double now_s) {
  camera_.use(lens(), now_s);
  camera_.look(now_s, plant_.tip(), camera_.lens() == Lens::kAdapter ? plant_.socket() : plant_.grapple());
}

std::optional<std::string> PayloadEquipment::picture(double now_s) {
  const auto view = camera_.deliver(now_s);
  if (!view) return std::nullopt;
  return target_message(*view);
}

void PayloadEquipment::ask(const ToolCommand& command) {
  carries_ = command.command == "carry";
  carries_ ? carrier_.ask(command) : grapple_.ask(command);
}

std::optional<ToolStatus> PayloadEquipment::carry(double now_s) {
  const double before = carrier_.share();
  const auto report = carrier_.act(now_s, {.takes_s = plant_.carry_s(),
                                           .arm_rests = plant_.fastest_rad_s() < kRests_rad_s,
                                           .has_torque = plant_.has_torque()});
  if (carrier_.share() != before) plant_.carry_base(carrier_.share());
  return report;
}

std::optional<ToolStatus> PayloadEquipment::act(double now_s) {
  if (carries_) return carry(now_s);
  const PayloadSite& site = *plant_.site();
  const auto report = grapple_.act(now_s, {.grapple_in_tip = relative(plant_.tip(), plant_.grapple()),
                                           .has_payload = site.holder() == Holder::kArm,
                                           .locked = site.adapter().lock() == Closure::kClosed});
  if (!report || report->phase != "done") return report;
  if (grapple_.command() == "grapple") plant_.take_payload();
  if (grapple_.command() == "release") plant_.let_go_of_payload();
  return report;
}

void PayloadEquipment::summarise(nlohmann::json& summary) const {
  const ToolStatus& last = carries_ ? carrier_.last() : grapple_.last();
  summary["tool"] = {{"number", last.number}, {"phase", last.phase}, {"reason", last.reason}};
}

}  // namespace liana::bench
