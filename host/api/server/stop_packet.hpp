// Recognises a stop in a packet that is no proper request: whoever wants to stop the arm is not sent back to correct
// the spelling.
#pragma once

#include <string>
#include <string_view>

namespace liana::api {

struct StopPacket {
  bool is_stop = false;
  std::string reason;  // as it was written, at most 1000 bytes, perhaps no UTF-8; empty when it has none
};

// Looks for the member "op" with the value "stop" of an object that may be cut short, nested too deep or badly encoded.
// One pass over the bytes, no recursion.
StopPacket read_stop(std::string_view packet);

}  // namespace liana::api
