// Standard output and error of programs that show names, logs and messages from elsewhere.
#pragma once

namespace liana::text {

// From now on what this process prints to either has no control characters (printable.hpp): nothing from elsewhere
// steers a terminal. What is meant to draw is written to the descriptor. Throws std::runtime_error without memory.
void print_only_text();

}  // namespace liana::text
