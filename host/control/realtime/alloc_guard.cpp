// For lianad_no_alloc (tests/CMakeLists.txt): stands in front of the C library and aborts when a tick allocates, locks
// or opens a file.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "host/control/realtime/tick_guard.hpp"

extern "C" {  // NOLINTBEGIN(bugprone-reserved-identifier): glibc calls them so
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* p, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* p);
}  // NOLINTEND(bugprone-reserved-identifier)

namespace {

void refuse_inside_tick(const char* what) {
  if (!liana::realtime::TickGuard::active()) return;
  static const char kText[] = "inside a tick: call of ";
  // Nothing that could allocate: plain writes, then abort.
  (void)!::write(STDERR_FILENO, kText, sizeof kText - 1);
  (void)!::write(STDERR_FILENO, what, std::strlen(what));
  (void)!::write(STDERR_FILENO, "\n", 1);
  std::abort();
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void* malloc(size_t size) noexcept {
  refuse_inside_tick("malloc");
  return __libc_malloc(size);
}

void* calloc(size_t count, size_t size) noexcept {
  refuse_inside_tick("calloc");
  return __libc_calloc(count, size);
}

void* realloc(void* p, size_t size) noexcept {
  refuse_inside_tick("realloc");
  return __libc_realloc(p, size);
}

void* aligned_alloc(size_t alignment, size_t size) noexcept {
  refuse_inside_tick("aligned_alloc");
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** out, size_t alignment, size_t size) noexcept {
  refuse_inside_tick("posix_memalign");
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? 12 : 0;
}

void free(void* p) noexcept {
  if (p != nullptr) refuse_inside_tick("free");
  __libc_free(p);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  refuse_inside_tick("pthread_mutex_lock");
  static const auto kNext = next<int (*)(pthread_mutex_t*)>("pthread_mutex_lock");
  return kNext(mutex);
}

int open(const char* path, int flags, ...) {
  refuse_inside_tick("open");
  va_list args;
  va_start(args, flags);
  const mode_t mode = va_arg(args, mode_t);
  va_end(args);
  return ::openat(AT_FDCWD, path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  refuse_inside_tick("fopen");
  static const auto kNext = next<FILE* (*)(const char*, const char*)>("fopen");
  return kNext(path, mode);
}

}  // extern "C"
