#include <algorithm>
#include <array>

#include "host/drives/canopen/sdo_client.hpp"

namespace liana::canopen {
namespace {

struct AbortName {
  std::uint32_t code;
  const char* text;
};

// CiA 301, table of SDO abort codes, in rising order.
constexpr std::array kAbortNames = {
    AbortName{0x05030000, "toggle bit not alternated"},
    AbortName{0x05040000, "SDO protocol timed out"},
    AbortName{0x05040001, "command not valid or unknown"},
    AbortName{0x05040005, "out of memory"},
    AbortName{0x06010000, "unsupported access"},
    AbortName{0x06010001, "object is write-only"},
    AbortName{0x06010002, "object is read-only"},
    AbortName{0x06020000, "object does not exist"},
    AbortName{0x06040041, "object cannot be mapped into a PDO"},
    AbortName{0x06040042, "mapped objects would exceed the PDO length"},
    AbortName{0x06040043, "incompatible parameter"},
    AbortName{0x06040047, "internal incompatibility in the device"},
    AbortName{0x06060000, "access failed because of a hardware error"},
    AbortName{0x06070010, "data type or length does not match"},
    AbortName{0x06070012, "data too long"},
    AbortName{0x06070013, "data too short"},
    AbortName{0x06090011, "sub-index does not exist"},
    AbortName{0x06090030, "value not allowed"},
    AbortName{0x06090031, "value too high"},
    AbortName{0x06090032, "value too low"},
    AbortName{0x06090036, "maximum is less than minimum"},
    AbortName{0x060A0023, "resource not available"},
    AbortName{0x08000000, "general error"},
    AbortName{0x08000020, "data cannot be stored"},
    AbortName{0x08000021, "data cannot be stored because of local control"},
    AbortName{0x08000022, "data cannot be stored in the present device state"},
    AbortName{0x08000023, "no object dictionary present"},
    AbortName{0x08000024, "no data available"},
};

}  // namespace

const char* abort_text(std::uint32_t code) noexcept {
  const auto* found =
      std::find_if(kAbortNames.begin(), kAbortNames.end(), [code](const AbortName& name) { return name.code == code; });
  return found == kAbortNames.end() ? "unknown abort code" : found->text;
}

}  // namespace liana::canopen
