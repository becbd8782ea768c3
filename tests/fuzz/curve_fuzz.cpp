// Curves of liana plan --follow.
#include "host/cli/curve_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static liana::fuzz::MemoryFile file;
  return liana::fuzz::refusing([&] { liana::cli::read_curve(file.with(liana::fuzz::text_of(data, size))); });
}
