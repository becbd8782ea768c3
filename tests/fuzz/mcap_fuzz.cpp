// MCAP files: records, chunks, checksums, summary.
#include "host/storage/recording/mcap.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile file;
  recording::McapVisitor visitor;
  visitor.message = [](const std::string&, std::uint32_t, std::uint64_t, std::string_view) {};
  visitor.metadata = [](const std::string&, const std::map<std::string, std::string>&) {};
  return fuzz::refusing([&] { recording::read_mcap(file.with(fuzz::text_of(data, size)), visitor); });
}
