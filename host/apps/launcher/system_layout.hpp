// What one `liana run` or `liana check` starts: where its files are and how every program is called.
#pragma once

#include <string>
#include <vector>

#include "host/apps/launcher/folder_lock.hpp"
#include "host/apps/launcher/run_options.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"

namespace liana::launcher {

// One program to start.
struct ProgramCall {
  std::string name;
  std::vector<std::string> argv;
  int realtime_priority = 0;  // over 0: SCHED_FIFO at that priority, where the machine grants it
};

// The files, sockets and programs of one run, all inputs checked.
struct SystemLayout {
  std::string directory;   // everything that is written; the user's with --record, else of a run one in runs_folder()
  std::string socket_dir;  // short temporary path: socket names are limited to 107 bytes
  FolderLock lock;         // of `directory` where that is one of the newest runs
  bool keep_directory = false;
  bool is_dry_run = false;
  bool has_recorder = false;   // liana-archive runs
  bool keeps_traffic = false;  // bus logs, which grow without bounds: not where nobody knows when it ends
  std::string time_mode;
  config::BusesConfig buses;
  config::SceneConfig scene;
  std::string robot;                  // its table's name or file, or the name of that in a plan
  bool is_serial = false;             // the robot has a serial arm
  Json mission;                       // its description (lua/liana/check.lua); null without one
  std::vector<ProgramCall> programs;  // in the order in which they start

  std::string file(const std::string& name) const { return directory + "/" + name; }
  std::string api_socket() const { return socket_dir + (is_dry_run ? "/dry" : "/api"); }  // estop looks for api
  std::string events_file() const { return file("events.txt"); }
  std::string commands_file() const { return file("commands.txt"); }
  std::string operator_file() const { return file("operator.json"); }
  std::string verify_times_file() const { return file("verify_times.txt"); }
  std::string bus_socket() const { return socket_dir + "/bus"; }
  std::string practice_socket() const { return socket_dir + "/practice"; }
};

// Evaluates and checks tables and mission, makes the directories, writes the tables there. Without a mission there is
// no operator either. Throws BadInput.
SystemLayout make_layout(const RunOptions& given);

// Makes a fresh folder for one run's files under $TMPDIR, locked while this process lives; its path is short enough for
// sockets. Those of processes that were killed are removed. Throws BadInput.
std::string temporary_directory();

// Refuses anything but empty text or two different drives from 0 to `drives` - 1, e.g. 3,4. Throws BadInput.
void check_cross_wired(const std::string& list, std::size_t drives);

// Removes what the run does not keep: of a success all but what lasts, and the oldest runs.
void clean_up(const SystemLayout& plan, bool success);

// Removes everything that the run has written, but for a folder of the user.
void discard(const SystemLayout& plan);

}  // namespace liana::launcher
