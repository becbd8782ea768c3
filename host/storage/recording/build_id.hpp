// Identity of the core this program was built from.
#pragma once

#include <string>

namespace liana::recording {

// SHA-256 over the core's sources, and the compiler: two builds with the same id understand each other's controller
// images.
std::string build_id();

}  // namespace liana::recording
