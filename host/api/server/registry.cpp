#include "host/api/server/registry.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "host/base/net/socket.hpp"

namespace liana::api {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxWords = 256;
constexpr std::size_t kMaxEntries = 100000;  // of one folder
constexpr std::size_t kMaxSystems = 256;
constexpr std::size_t kMaxUnseen = 64;

std::string runtime_folder() {
  const char* given = std::getenv("XDG_RUNTIME_DIR");
  if (given != nullptr && *given != '\0') return given;
  const std::string usual = "/run/user/" + std::to_string(::getuid());
  return fs::exists(usual) ? usual : "/tmp";
}

// In /tmp anybody may have made a folder of this name: links in it could lead anywhere.
void require_own(const std::string& folder) {
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0) throw std::runtime_error(folder + ": " + std::strerror(errno));
  const std::string remedy = "; remove it, set XDG_RUNTIME_DIR, or name sockets with --api";
  if (!S_ISDIR(found.st_mode) || found.st_uid != ::getuid())
    throw std::runtime_error(folder + ": is not a folder of this user" + remedy);
  if ((found.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    throw std::runtime_error(folder + ": others than this user may write there" + remedy);
}

// The words of its command line; none where the process is no lianad that runs.
std::vector<std::string> words_of_lianad(const std::string& process) {
  std::ifstream name_file("/proc/" + process + "/comm"), words_file("/proc/" + process + "/cmdline");
  std::string name;
  if (!std::getline(name_file, name) || name != "lianad") return {};
  std::vector<std::string> words;
  for (std::string word; words.size() < kMaxWords && std::getline(words_file, word, '\0');) words.push_back(word);
  return words;
}

std::string option(const std::vector<std::string>& words, const std::string& name) {
  std::string value;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == name && i + 1 < words.size()) value = words[i + 1];
    if (words[i].starts_with(name + "=")) value = words[i].substr(name.size() + 1);
  }
  return value;
}

// Nobody will ever listen there again; anything else that keeps us from connecting says nothing about it.
bool is_dead(const std::string& socket, const std::string& process) {
  if (is_listening(socket)) return false;
  constexpr int kNobody[]{ECONNREFUSED, ENOENT, ENOTDIR, ELOOP, ENAMETOOLONG, EPROTOTYPE};
  return std::find(std::begin(kNobody), std::end(kNobody), errno) != std::end(kNobody) &&
         words_of_lianad(process).empty();
}

bool is_number(std::string_view text) {
  return !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// One look at every place where a system can be.
class Search {
 public:
  explicit Search(const std::function<void(const std::string&)>& found) : found_(found) {}

  // The folder of links of one user; links are believed where folder and socket are that user's.
  void look_at_links(const std::string& folder, ::uid_t user) {
    struct stat status {};
    const bool is_ours = user == ::getuid();
    if (::lstat(folder.c_str(), &status) != 0) return miss(folder, errno, is_ours);
    if (!S_ISDIR(status.st_mode) || status.st_uid != user)
      return miss(folder, "is not a folder of " + (is_ours ? "this user" : "user " + std::to_string(user)), is_ours);
    for_each(folder, is_ours, [&](const std::string& name) {
      std::error_code error;
      const std::string socket = fs::read_symlink(fs::path(folder) / name, error).string();
      if (!error && belongs_to(socket, user) && !is_dead(socket, name)) offer(socket);
    });
  }
  // A folder that may hold folders of links, and those of runs.
  void look_in(const std::string& folder, bool is_ours = false) {
    for_each(folder, is_ours, [&](const std::string& name) {
      const std::string inside = folder + "/" + name;
      if (name.starts_with("liana-run-")) look_for_socket(inside + "/api");
      if (name.starts_with("liana-") && is_number(name.substr(6)))
        look_at_links(inside, static_cast<::uid_t>(std::stoul(name.substr(6))));
    });
  }
  void look_among_users() {
    for_each("/run/user", false, [&](const std::string& name) { look_in("/run/user/" + name); });
  }
  // Of the services that systemd starts (host/apps/install/lianad@.service.in), and /run as a runtime folder itself.
  void look_among_services() {
    look_in("/run");
    for_each("/run", false, [&](const std::string& name) {
      if (!name.starts_with("liana") || is_number(name.substr(name.find('-') + 1))) return;
      look_for_socket("/run/" + name + "/api.sock");
      look_in("/run/" + name);
    });
  }
  // What moves a real arm is found wherever its socket is. In virtual time an arm is simulated.
  void look_among_processes() {
    for_each("/proc", true, [&](const std::string& process) {
      if (!is_number(process)) return;
      const std::vector<std::string> words = words_of_lianad(process);
      if (option(words, "--time") == "real") look_at_process("/proc/" + process, option(words, "--api"));
    });
  }
  std::vector<Unseen> unseen() && { return std::move(unseen_); }

 private:
  void look_for_socket(const std::string& socket) {
    struct stat status {};
    if (::stat(socket.c_str(), &status) != 0) return miss(socket, errno, false);
    if (S_ISSOCK(status.st_mode) && !is_dead(socket, "")) offer(socket);
  }
  void look_at_process(const std::string& process, std::string socket) {
    struct stat status {};
    if (::stat(process.c_str(), &status) != 0) return;  // it has ended
    if (!socket.starts_with('/')) {
      std::error_code error;
      const fs::path folder = fs::read_symlink(process + "/cwd", error);
      if (error) {
        return miss("the API socket '" + socket + "' of lianad (process " + process.substr(6) + ")", error.message(),
                    true);
      }
      socket = folder / socket;
    }
    // It may see other files than we do.
    const std::string seen_by_it = process + "/root" + socket;
    std::error_code error;
    if (!fs::exists(socket, error) && !error && fs::exists(seen_by_it, error)) socket = seen_by_it;
    if (belongs_to(socket, status.st_uid)) offer(socket);
  }
  // Where that cannot be known, connecting says why.
  static bool belongs_to(const std::string& socket, ::uid_t user) {
    struct stat status {};
    return ::stat(socket.c_str(), &status) != 0 || status.st_uid == user;
  }
  void offer(const std::string& socket) {
    struct stat status {};
    const bool is_there = ::stat(socket.c_str(), &status) == 0;
    if (is_there ? !files_.emplace(status.st_dev, status.st_ino).second : !names_.insert(socket).second) return;
    if (++count_ <= kMaxSystems) return found_(socket);
    if (count_ == kMaxSystems + 1) miss(socket, "more than 256 systems run", true);
  }
  // Names of one folder; those that come after a failure are missed, and said to be.
  template <class Visit>
  void for_each(const std::string& folder, bool is_ours, const Visit& visit) {
    std::error_code error;
    std::size_t left = kMaxEntries;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      if (left-- == 0) return miss(folder, "holds more than 100000 files", is_ours);
      visit(entry->path().filename().string());
    }
    if (error) miss(folder, error.value(), is_ours);
  }
  void miss(const std::string& place, int why, bool is_ours) {
    if (why != ENOENT && why != ENOTDIR) miss(place, std::strerror(why), is_ours);
  }
  void miss(const std::string& place, const std::string& why, bool is_ours) {
    const bool is_new = std::none_of(unseen_.begin(), unseen_.end(), [&](const Unseen& u) { return u.place == place; });
    if (is_new && (is_ours || unseen_.size() < kMaxUnseen)) unseen_.push_back({place, why, is_ours});
  }

  const std::function<void(const std::string&)>& found_;
  std::set<std::pair<::dev_t, ::ino_t>> files_;
  std::set<std::string> names_;
  std::size_t count_ = 0;
  std::vector<Unseen> unseen_;
};

}  // namespace

std::string registry_folder() { return runtime_folder() + "/liana-" + std::to_string(::getuid()); }

Registration::Registration(const std::string& api_socket)
    : link_(registry_folder() + "/" + std::to_string(::getpid())) {
  const std::string folder = registry_folder();
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw std::runtime_error(folder + ": " + std::strerror(errno));
  require_own(folder);
  fs::remove(link_);  // of a dead process that had our number
  fs::create_symlink(fs::absolute(api_socket), link_);
}

Registration::~Registration() {
  std::error_code error;
  fs::remove(link_, error);
}

std::vector<std::string> running_systems() {
  const std::string folder = registry_folder();
  if (!fs::exists(folder)) return {};
  require_own(folder);
  struct System {
    bool has_no_process;
    std::string socket;
    fs::path link;
  };
  std::vector<System> systems;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string socket = fs::read_symlink(entry.path(), error).string(), process = entry.path().filename();
    if (error) continue;
    if (is_dead(socket, process)) {
      fs::remove(entry.path(), error);
    } else {
      systems.push_back({words_of_lianad(process).empty(), socket, entry.path()});
    }
  }
  // Those whose process is there first: another link to the same socket is of a lianad that was killed.
  std::sort(systems.begin(), systems.end(), [](const System& a, const System& b) {
    return std::tie(a.has_no_process, a.socket) < std::tie(b.has_no_process, b.socket);
  });
  std::vector<std::string> sockets;
  std::set<std::pair<::dev_t, ::ino_t>> files;
  for (const System& system : systems) {
    struct stat status {};
    const bool is_there = ::stat(system.socket.c_str(), &status) == 0;
    if (!is_there || files.emplace(status.st_dev, status.st_ino).second) {
      sockets.push_back(system.socket);
    } else if (system.has_no_process) {
      fs::remove(system.link, error);
    }
  }
  std::sort(sockets.begin(), sockets.end());
  return sockets;
}

// Processes before the folders of others: those may be many, or lie on a disk that does not answer.
std::vector<Unseen> look_everywhere(const std::function<void(const std::string&)>& found) {
  Search search(found);
  const char* given = std::getenv("XDG_RUNTIME_DIR");
  search.look_at_links(registry_folder(), ::getuid());
  search.look_among_processes();
  if (given != nullptr && *given != '\0') search.look_in(given, true);
  search.look_among_users();
  search.look_among_services();
  search.look_in("/tmp");
  std::error_code none;
  search.look_in(fs::temp_directory_path(none));
  return std::move(search).unseen();
}

std::string places_to_look() {
  return registry_folder() + ", /run/user, /run/liana*, /tmp, $TMPDIR and among the programs that run in real time";
}

}  // namespace liana::api
