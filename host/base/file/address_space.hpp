// How much memory a process may map.
#pragma once

#include <sys/resource.h>

#ifndef __has_feature  // clang says it so, g++ by a macro
#define __has_feature(name) 0
#endif

namespace liana::file {

// From now on this process and its children map at most so many bytes; a lower limit that is there already stays. A
// build with AddressSanitizer has none: its shadow is larger than any.
inline void limit_address_space([[maybe_unused]] rlim_t most_bytes) noexcept {
#if !defined(__SANITIZE_ADDRESS__) && !__has_feature(address_sanitizer)
  const rlimit both{most_bytes, most_bytes};
  ::setrlimit(RLIMIT_AS, &both);
#endif
}

}  // namespace liana::file
