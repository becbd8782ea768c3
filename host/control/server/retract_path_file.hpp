// The verified way back on disk, so that it survives lianad: a ring of points that a thread of its own keeps up to
// date. Who notes a point never waits for a disk. What a torn write leaves is not read.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "host/base/event/event.hpp"
#include "host/control/arbiter/way_points.hpp"

namespace liana::server {

// What a path was verified with: the texts of its tables, hashed in the file. Each has to be the same where the path is
// taken over.
struct PathBasis {
  std::string name;                       // of the robot, for messages
  std::string robot, calibration, scene;  // the robot's table without named poses; calibration: empty without one
};

class RetractPathFile {
 public:
  // Of an arm with so many joints. Makes the file, or reads it. Throws std::runtime_error when it cannot be opened,
  // another lianad has it, or it is no such file. The path of another basis is not taken over: it stays in
  // PATH.unused (PATH.unused-2 and so on where there is one already), and trouble() says so.
  RetractPathFile(const std::string& path, const PathBasis& basis, std::size_t joints);
  // Writes what waits.
  ~RetractPathFile();
  RetractPathFile(const RetractPathFile&) = delete;
  RetractPathFile& operator=(const RetractPathFile&) = delete;

  // What the last lianad left; points whose checksum is wrong, or that are no finite angles, are missing, with all
  // before them.
  const arbiter::KeptWay& kept() const { return kept_; }
  // Hands the change to the thread.
  void follow(const arbiter::WayChange& change);
  // What the file held is not used, or the disk has refused a write and nothing is kept any more; each said once.
  std::optional<event::Event> trouble();

 private:
  void open();
  void read();
  void put_aside(const std::string& why);
  void work();
  bool write(const arbiter::WayChange& change);
  bool write_header(std::uint64_t first, std::uint64_t end);
  bool write_point(std::uint64_t number, const arbiter::WayPoint& point);
  std::optional<arbiter::WayPoint> read_point(std::uint64_t number) const;
  std::size_t record_bytes() const;

  std::string path_;
  std::size_t joints_;
  std::string robot_;
  std::array<std::uint64_t, 3> basis_;  // hashes of robot, calibration, scene
  std::string unused_;                  // why the path in the file is not used; empty: it is, or it was told
  int fd_ = -1;
  arbiter::KeptWay kept_;
  std::uint64_t end_ = 0;     // in the file; of the thread alone, as is the next
  std::size_t unsynced_ = 0;  // points

  std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::optional<arbiter::WayChange> waiting_;
  std::string problem_;  // empty: none
  bool told_ = false;
  bool ending_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace liana::server
