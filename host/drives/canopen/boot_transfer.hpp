// One object of a boot plan over SDO: read and compared, or written and read back.
#pragma once

#include <cstdint>
#include <optional>

#include "host/drives/canopen/boot_plan.hpp"
#include "host/drives/canopen/sdo_client.hpp"

namespace liana::canopen {

enum class TransferResult : std::uint8_t {
  kNotYet,
  kRight,    // found() is what the plan wants
  kMissing,  // the drive has no such object, and need not
  kWrong,    // found() is not what the plan wants
  kAborted,  // the drive refused: abort_code(), of the write where there was one
  kSilent    // it did not answer, three times
};

class BootTransfer {
 public:
  // Begins with object number `at` of the plan. With `look_only` nothing is written: an object that would be is right
  // when it can be read.
  void begin(const BootPlan& plan, std::size_t at, bool look_only, SdoClient& sdo) noexcept;
  // The SDO client has finished. `before` is what was found in the object before this one, if anything was.
  TransferResult advance(const BootPlan& plan, std::optional<std::uint32_t> before, SdoClient& sdo) noexcept;

  std::optional<std::uint32_t> found() const noexcept { return found_; }
  // Bytes that the drive says the object has; 0: it was not read, or does not say.
  std::size_t said_bytes() const noexcept { return said_bytes_; }
  std::uint32_t abort_code() const noexcept { return abort_code_; }

 private:
  enum class Stage : std::uint8_t { kLook, kWrite, kReadBack, kReadRefused };
  void enter(Stage stage, SdoClient& sdo) noexcept;
  void request(SdoClient& sdo) noexcept;
  TransferResult refused(SdoClient& sdo) noexcept;
  TransferResult read(const BootPlan& plan, std::optional<std::uint32_t> before, SdoClient& sdo) noexcept;

  BootObject const* object_ = nullptr;
  std::size_t at_ = 0;
  bool writes_ = false;
  Stage stage_ = Stage::kLook;
  int attempts_ = 0;
  bool look_only_ = false;
  int settling_ = 0;         // reads so far of an object that may take its time
  std::uint32_t value_ = 0;  // to be written
  std::optional<std::uint32_t> found_;
  std::size_t said_bytes_ = 0;
  std::uint32_t abort_code_ = 0;
};

}  // namespace liana::canopen
