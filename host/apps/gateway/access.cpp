#include "host/apps/gateway/access.hpp"
#include "host/base/file/in_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace liana::gateway {
namespace {

constexpr std::array<const char*, 3> kNames{"watch", "operate", "administer"};
constexpr std::size_t kLongestKeyName = 32, kShortestToken = 16, kLongestToken = 128;

std::optional<Access> access_from(const std::string& name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Access>(found - kNames.begin());
}

bool is_name(const std::string& text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  return !text.empty() && text.size() <= kLongestKeyName && std::all_of(text.begin(), text.end(), allowed);
}

bool is_token(const std::string& text) {
  const auto printable = [](char c) { return c > 0x20 && c < 0x7F; };
  return text.size() >= kShortestToken && text.size() <= kLongestToken &&
         std::all_of(text.begin(), text.end(), printable);
}

void require_private(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0)
    throw std::runtime_error("--token-file " + file + ": cannot be read: " + std::strerror(errno));
  if ((status.st_mode & 077) != 0)
    throw std::runtime_error("--token-file " + file +
                             ": others than its owner may read or write it; allowed is mode 0600: chmod 600 " + file);
}

// Never shows the token.
void read_line(const std::string& place, const std::string& line, Tokens& tokens) {
  std::istringstream words(line);
  std::string name, role, secret, more;
  words >> name >> role >> secret;
  const auto access = access_from(role);
  const bool whole = !(words >> more) && is_name(name) && access && is_token(secret);
  if (!whole)
    throw std::runtime_error(place +
                             ": allowed are NAME ROLE TOKEN: a name of 1 to 32 letters, digits, _ - or ., one of watch "
                             "operate administer, and 16 to 128 printable characters; make a token with openssl rand "
                             "-hex 24");
  if (!tokens.emplace(name, Token{*access, secret}).second)
    throw std::runtime_error(place + ": the name '" + name + "' stands there twice; give each person one line");
}

}  // namespace

const char* access_name(Access access) { return kNames[static_cast<std::size_t>(access)]; }

bool may_ask(Access access, std::string_view op) {
  if (op == "stop") return true;
  if (op == "hello" || op == "done") return false;  // the gateway says hello, and nobody waits for its clients
  if (op == "shutdown") return access == Access::kAdminister;
  return access != Access::kWatch;
}

Tokens read_tokens(const std::string& file) {
  require_private(file);
  file::require_ordinary(file);
  std::ifstream in(file);
  if (!in) throw std::runtime_error("--token-file " + file + ": cannot be read; give a file that you may read");
  Tokens tokens;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with("#")) continue;
    read_line("--token-file " + file + ", line " + std::to_string(number), line, tokens);
  }
  if (tokens.empty()) throw std::runtime_error("--token-file " + file + ": has no token; add a line NAME ROLE TOKEN");
  return tokens;
}

}  // namespace liana::gateway
