// Options that the measuring programs share: --count N (cases), --json (for programs).
#pragma once

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace liana::numbers {

struct Options {
  std::int32_t count;
  bool json = false;
};

// Ends the program with exit code 2 on anything else.
inline Options parse_options(int argc, char** argv, std::int32_t count) {
  Options options{count};
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--json") {
      options.json = true;
      continue;
    }
    const std::string_view value = word == "--count" && i + 1 < argc ? argv[++i] : "";
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), options.count);
    if (error != std::errc{} || end != value.data() + value.size() || options.count < 1 || options.count > 1000000) {
      std::fprintf(stderr, "%s: bad option %s: allowed: --count 1 to 1000000, --json\n", argv[0], argv[i]);
      std::exit(2);
    }
  }
  return options;
}

}  // namespace liana::numbers
