// Files and standard output of `liana`: whether they can be written is known before the work, and what was lost is said
// after it.
#pragma once

#include <string>

namespace liana::launcher {

// Tries whether the file that `option` names can be written, and leaves it as it was; throws BadInput with the reason.
// Only the permissions of what is no ordinary file (a device, a pipe) are looked at.
void check_output(const std::string& option, const std::string& path);

// Replaces the file by `text`, or leaves it as it was; throws std::runtime_error with the reason.
void write_output(const std::string& path, const std::string& text);

// The exit code of a program that ends with `code`: kExitFailure, with a message, when standard output did not take
// everything.
int after_standard_output(int code);

}  // namespace liana::launcher
