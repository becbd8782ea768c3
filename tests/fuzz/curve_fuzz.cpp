// Curves of liana plan --follow.
#include "host/apps/cli/curve_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return liana::fuzz::refusing(
      [&] { liana::cli::parse_curve(std::string(liana::fuzz::text_of(data, size)), "curve"); });
}
