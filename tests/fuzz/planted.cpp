// A target with a bug, of the kind that is looked for: `./dev test` sees that the fuzzer finds it.
#include <vector>

#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint8_t> bytes(data, data + size);
  if (size < 3 || bytes[0] != 'B' || bytes[1] != 'U' || bytes[2] != 'G') return 0;
  return bytes.data()[size] == 1 ? -1 : 0;  // behind its end
}
