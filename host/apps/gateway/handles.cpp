#include "host/apps/gateway/handles.hpp"

#include <array>
#include <utility>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/request_table.hpp"

namespace liana::gateway {

namespace {

using api::FieldType;
using api::RequestField;

constexpr double kGripped = 0.5;  // of a trigger: from here on the deadman is held
constexpr double kRoom_m = 10.0;  // a device frame's size
constexpr double kRate_hz = 90.0;

constexpr std::array kHandle{
    RequestField{"valid", FieldType::kFlag, "the handle is tracked"},
    RequestField{"trigger", FieldType::kNumber, "deadman; held from 0.5 on", 0.0, 1.0},
    RequestField{"pose", FieldType::kPose, "of the handle in the device frame", {}, kRoom_m},
    RequestField{"stale", FieldType::kFlag, "the headset was re-centred in this grip"}.optional(),
};
constexpr std::array kHandlesSample{
    RequestField{"t_us", FieldType::kInteger, "when it was taken, by the page's clock", 0.0, api::kBiggestWhole},
    RequestField{"right", FieldType::kObject, "the hand that moves the tip", {}, {}, {}, kHandle},
    RequestField{"left", FieldType::kObject, "the hand that moves a node", {}, {}, {}, kHandle},
};
constexpr std::array kKinds{"vr"};
constexpr std::array kDevice{
    RequestField{"device", FieldType::kWord, "where the samples come from", {}, {}, kKinds},
    RequestField{"samples", FieldType::kObject, "since the last message, oldest first", {}, {}, {}, kHandlesSample}
        .list(64),
};
constexpr api::RequestRow kRow{.op = "device", .fields = kDevice};

// What lianad takes for a name: other characters become '_'.
std::string device_name(const std::string& client) {
  constexpr std::string_view kBehind = "-vr";
  std::string name = client.substr(0, LIANA_NAME_BYTES - 1 - kBehind.size());
  for (char& c : name) {
    const bool stays = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.';
    if (!stays) c = '_';
  }
  return name + std::string(kBehind);
}

device::Capability capability(const std::string& name) {
  const liana_hand hand{LIANA_ALL_AXES, 0, 0, 0, {-kRoom_m, -kRoom_m, -kRoom_m}, {kRoom_m, kRoom_m, kRoom_m}, 0.0, 0.0};
  return {name, device::Kind::kVrControllers, 2, kRate_hz, 0.1, {hand, hand}};
}

device::Sample sample_of(const api::Arguments& fields, std::uint32_t hand, std::int64_t t_us) {
  device::Sample sample{.t_us = t_us, .hand = hand, .valid = fields.flag("valid")};
  sample.trigger = fields.number("trigger");
  sample.stale = fields.has("stale") && fields.flag("stale");
  sample.deadman = sample.trigger >= kGripped;
  sample.pose = fields.pose("pose");
  return sample;
}

}  // namespace

Handles::Handles(Poller& poller, std::string devices, const std::string& client,
                 std::function<void(const std::string& why)> refused)
    : poller_(poller), devices_(std::move(devices)), name_(device_name(client)), refused_(std::move(refused)) {}

void Handles::connect() {
  if (driver_) return;
  try {
    driver_ = device::Driver::connect(devices_, capability(name_), 0, 0.0);
  } catch (const std::runtime_error& error) {
    throw api::RequestError("away", error.what());
  }
  if (driver_->is_open()) poller_.watch(driver_->fd(), EPOLLIN, [this](std::uint32_t) { ready(); });
}

void Handles::leave() {
  if (!driver_) return;
  if (driver_->is_open()) poller_.forget(driver_->fd());
  driver_->leave();
  driver_.reset();
}

// The page's clock is not known here: its states are not echoed.
void Handles::ready() {
  const int fd = driver_->fd();
  driver_->receive(std::nullopt);
  if (driver_->is_open()) return;
  poller_.forget(fd);
  const std::string why = driver_->problem();
  driver_.reset();
  refused_(why);
}

void Handles::take(const Json& message) {
  static const api::RequestBounds kNoRobot;
  const api::Arguments fields = api::checked(kRow, message, kNoRobot);
  connect();
  for (const api::Arguments& entry : fields.entries("samples")) {
    const std::int64_t t_us = entry.integer("t_us");
    driver_->send(sample_of(entry.object("right"), 0, t_us));
    driver_->send(sample_of(entry.object("left"), 1, t_us));
  }
}

}  // namespace liana::gateway
