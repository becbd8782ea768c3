// A file from elsewhere that is read: an ordinary one. A pipe would be waited for, and a device never ends.
#pragma once

#include <optional>
#include <string>

namespace liana::file {

// Throws std::runtime_error "PATH: is a pipe ..." for what is there and is no ordinary file, or a link to one; says
// nothing of what is not there or may not be read.
void require_ordinary(const std::string& path);

// All bytes of an ordinary file; nothing where it is not there or may not be read. Throws as require_ordinary() does.
std::optional<std::string> content_of(const std::string& path);

}  // namespace liana::file
