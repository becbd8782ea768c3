#include "tests/host/drives/bus/allocation_count.hpp"

#include <cstdlib>
#include <new>

namespace {

thread_local bool g_counting = false;
thread_local int g_allocations = 0;

}  // namespace

namespace liana::test {

void AllocationCount::start() { g_counting = true; }
void AllocationCount::stop() { g_counting = false; }
void AllocationCount::clear() { g_allocations = 0; }
int AllocationCount::value() { return g_allocations; }

}  // namespace liana::test

// Not inlined: g++ 12 takes one half of a pair that is for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (g_counting) ++g_allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
