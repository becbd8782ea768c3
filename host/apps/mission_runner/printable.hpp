// What scripts say, on its way to a terminal.
#pragma once

#include <string>
#include <string_view>

namespace liana::mission_runner {

// The text with a ? for every control character but tab and the end of a line: terminals act on them.
std::string printable(std::string_view text);

}  // namespace liana::mission_runner
