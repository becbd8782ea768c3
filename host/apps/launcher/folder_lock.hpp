// A lock in a folder: the processes of one run hold it, and nobody removes the folder while they do.
// It is flock() on a file, which NFS carries to the server since Linux 2.6.12; a mount with nolock or local_lock=flock
// is assumed not to be shared by several machines.
#pragma once

#include <memory>
#include <string>

#include "host/base/net/socket.hpp"

namespace liana::launcher {

constexpr const char* kLockFile = "lock";

// Held while one copy of it is left, and while a process runs that was started in the meantime. Empty: not held.
using FolderLock = std::shared_ptr<const api::UniqueFd>;

// Puts a lock file with `text` into a folder that this process has made, and holds it: the file appears held. Empty,
// and without the file, where the file system gives no locks. Throws std::runtime_error where no file can be made.
FolderLock hold_new_folder(const std::string& folder, const std::string& text);

// The lock of a folder that nobody holds. Empty when somebody does, when there is no lock file, or when the file system
// does not say.
FolderLock take_unheld_folder(const std::string& folder);

// Removes a folder whose lock was taken, the lock file last: an interrupted removal is repeated by whoever comes next.
void remove_held_folder(const std::string& folder);

// Removes this user's folders under $TMPDIR whose names begin so, and whose processes were killed: nobody holds them.
void remove_leftovers(const std::string& prefix);

}  // namespace liana::launcher
