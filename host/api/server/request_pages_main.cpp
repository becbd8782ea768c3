// Writes what is made of the table of requests into docs/reference/api.md and lua/liana/arm_stubs.lua.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>

#include "host/api/server/request_pages.hpp"

namespace {

void write(const std::string& folder, const liana::api::MadeSection& section) {
  const std::string file = folder + "/" + section.file;
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string made = liana::api::with_section(section, text, section.make());
  std::ofstream(file, std::ios::binary) << made;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "request_pages: give the source directory\n");
    return 2;
  }
  try {
    write(argv[1], liana::api::kRequestSection);
    write(argv[1], liana::api::kCommandStubs);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "request_pages: %s\n", error.what());
    return 1;
  }
}
