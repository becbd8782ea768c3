#include "host/drives/canopen/boot_transfer.hpp"

#include <array>

#include "host/drives/canopen/messages.hpp"

namespace liana::canopen {
namespace {

constexpr int kSettlingReads = 125;  // half a second at 250 Hz, at least a tick for each
constexpr int kAttempts = 3;         // each of its requests may be lost twice

}  // namespace

void BootTransfer::begin(const BootPlan& plan, std::size_t at, bool look_only, SdoClient& sdo) noexcept {
  object_ = &plan.objects()[at];
  at_ = at;
  writes_ = object_->write && !look_only;
  value_ = object_->value;
  found_.reset();
  said_bytes_ = 0;
  look_only_ = look_only;
  settling_ = 0;
  abort_code_ = 0;
  enter(writes_ && object_->keep == 0 ? Stage::kWrite : Stage::kLook, sdo);
}

void BootTransfer::enter(Stage stage, SdoClient& sdo) noexcept {
  stage_ = stage;
  attempts_ = 0;
  request(sdo);
}

void BootTransfer::request(SdoClient& sdo) noexcept {
  if (stage_ != Stage::kWrite) return sdo.start_upload(object_->index, object_->sub);
  std::array<std::uint8_t, 4> bytes{};
  put_u32(bytes.data(), 4, value_);
  sdo.start_download(object_->index, object_->sub, {bytes.data(), object_->bytes});
}

TransferResult BootTransfer::advance(const BootPlan& plan, std::optional<std::uint32_t> before,
                                     SdoClient& sdo) noexcept {
  switch (sdo.status()) {
    case SdoStatus::kTimeout:
      if (++attempts_ >= kAttempts) return TransferResult::kSilent;
      request(sdo);
      return TransferResult::kNotYet;
    case SdoStatus::kAborted:
      return refused(sdo);
    case SdoStatus::kDone:
      if (stage_ != Stage::kWrite) return read(plan, before, sdo);
      if (!object_->read_back) return TransferResult::kRight;
      enter(Stage::kReadBack, sdo);
      return TransferResult::kNotYet;
    case SdoStatus::kIdle:
    case SdoStatus::kBusy:
      break;
  }
  return TransferResult::kNotYet;
}

// What cannot be written may have the value already: a constant of the drive, or set by its maker's tool.
TransferResult BootTransfer::refused(SdoClient& sdo) noexcept {
  const bool missing = sdo.abort_code() == kAbortNoObject || sdo.abort_code() == kAbortNoSubIndex;
  if (missing && object_->may_be_missing) return TransferResult::kMissing;
  if (stage_ != Stage::kReadRefused) abort_code_ = sdo.abort_code();
  if (missing || stage_ != Stage::kWrite) return TransferResult::kAborted;
  enter(Stage::kReadRefused, sdo);
  return TransferResult::kNotYet;
}

TransferResult BootTransfer::read(const BootPlan& plan, std::optional<std::uint32_t> before, SdoClient& sdo) noexcept {
  found_ = sdo.value();
  said_bytes_ = sdo.said_bytes();
  const bool right = plan.accepts(at_, *found_, before);
  switch (stage_) {
    case Stage::kReadRefused:
      return right ? TransferResult::kRight : TransferResult::kAborted;
    case Stage::kLook:
      if (object_->write && !writes_) return TransferResult::kRight;
      if (!right && object_->settles) {
        if (look_only_) return TransferResult::kRight;  // nothing was written that it could show
        if (++settling_ >= kSettlingReads) break;
        enter(Stage::kLook, sdo);
        return TransferResult::kNotYet;
      }
      if (right || !writes_) break;
      value_ = object_->value | (*found_ & object_->keep);
      enter(Stage::kWrite, sdo);
      return TransferResult::kNotYet;
    case Stage::kReadBack:
    case Stage::kWrite:
      break;
  }
  return right ? TransferResult::kRight : TransferResult::kWrong;
}

}  // namespace liana::canopen
