// The verified way back on disk, so that it survives lianad: a ring of points that a thread of its own keeps up to
// date. Who notes a point never waits for a disk. What a torn write leaves is not read.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "host/base/event/event.hpp"
#include "host/control/arbiter/way_points.hpp"

namespace liana::server {

class RetractPathFile {
 public:
  // Of the robot `robot` with so many joints. Makes the file, or reads it. Throws std::runtime_error when it cannot be
  // opened, another lianad has it, or it is no such file. The way of another robot is not taken over.
  RetractPathFile(const std::string& path, const std::string& robot, std::size_t joints);
  // Writes what waits.
  ~RetractPathFile();
  RetractPathFile(const RetractPathFile&) = delete;
  RetractPathFile& operator=(const RetractPathFile&) = delete;

  // What the last lianad left; points whose checksum is wrong are missing, with all before them.
  const arbiter::KeptWay& kept() const { return kept_; }
  // Hands the change to the thread.
  void follow(const arbiter::WayChange& change);
  // The disk has refused a write, said once: nothing is kept any more.
  std::optional<event::Event> trouble();

 private:
  void open();
  void read(const std::string& robot);
  void work();
  bool write(const arbiter::WayChange& change);
  bool write_header(std::uint64_t first, std::uint64_t end);
  bool write_point(std::uint64_t number, const arbiter::WayPoint& point);
  std::optional<arbiter::WayPoint> read_point(std::uint64_t number) const;
  std::size_t record_bytes() const;

  std::string path_;
  std::size_t joints_;
  std::uint32_t robot_crc_;
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
