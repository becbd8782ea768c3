// Which cables an arm has lost, on disk beside its way back: a lianad that is started anew does not pull at the arm as
// if it were whole.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace liana::server {

class LossFile {
 public:
  // Reads what an earlier lianad has left at `path` of this robot, whose drives are so many. A missing file, or another
  // robot's, says nothing. Throws std::runtime_error where the file can't be read as one of these.
  LossFile(std::string path, std::string robot, std::size_t drives);

  // Cables that are lost, as the file says; 0-based, ascending.
  const std::vector<std::size_t>& cables() const { return cables_; }
  // From now on these are; none: the file goes. False where the disk refuses it.
  bool note(const std::vector<std::size_t>& cables);

 private:
  std::string path_, robot_;
  std::vector<std::size_t> cables_;
};

}  // namespace liana::server
