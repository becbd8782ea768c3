// SQLite as the archive uses it: files, statements that are prepared once, errors that name the file.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace liana::archive {

// What SQLite said, with the file.
struct DatabaseError : std::runtime_error {
  DatabaseError(const std::string& what, bool full) : std::runtime_error(what), is_full(full) {}
  bool is_full;  // the disk takes no more
};

// Bytes that are no text.
struct Blob {
  std::string_view bytes;
};

class Database {
 public:
  enum class Open {
    kRead,  // what is there, also while another process writes; what a killed writer left half done is undone. Throws
            // DatabaseError where the file has more than tables and indexes.
    kDurable,  // made when missing; what was committed outlives the loss of power
    kQuick,    // made when missing; what was committed outlives the process, and all but the last moments loss of power
  };
  // Throws DatabaseError.
  Database(const std::string& path, Open how);

  // One or more statements without values. Throws DatabaseError.
  void run(const std::string& sql);
  // Nothing more is written: one plain file, without those that WAL keeps beside it, unless somebody reads it just now
  // or the disk is full.
  void finish();
  // What `PRAGMA integrity_check` finds wrong; empty: nothing. `quick` leaves out whether indexes agree with tables.
  std::string problem(bool quick) const;
  const std::string& path() const { return path_; }

 private:
  friend class Statement;
  [[noreturn]] void refuse() const;
  void check(int code) const;
  void require_own_tables() const;

  struct Close {
    void operator()(void* database) const;
  };
  std::string path_;
  std::unique_ptr<void, Close> handle_;  // sqlite3: its header stays in one file
};

// One statement of a database, which must outlive it. Columns count from 0.
class Statement {
 public:
  Statement(const Database& database, const std::string& sql);

  // Runs it to its end with these values in the order of its question marks. Throws DatabaseError.
  template <class... Values>
  void run(const Values&... values) {
    bind(values...);
    while (step()) {
    }
  }
  // The same with numbers only, whole ones as such where their column is INTEGER; NaN is NULL.
  void run_row(const std::vector<double>& values);
  // Gives the values; rows follow by step().
  template <class... Values>
  void bind(const Values&... values) {
    reset();
    int place = 0;
    (put(++place, values), ...);
  }
  // Whether there is a next row. Throws DatabaseError.
  bool step();

  bool is_null(int column) const;
  std::int64_t whole(int column) const;
  std::uint64_t count(int column) const { return static_cast<std::uint64_t>(whole(column)); }
  double real(int column) const;
  std::string text(int column) const;  // or the bytes of a blob

 private:
  void reset();
  void put(int place, std::nullptr_t);
  void put_whole(int place, std::int64_t value);
  void put(int place, double value);
  void put(int place, std::string_view text);
  void put(int place, const char* text) { put(place, std::string_view(text)); }
  void put(int place, const std::string& text) { put(place, std::string_view(text)); }
  void put(int place, Blob blob);
  template <std::integral Whole>
  void put(int place, Whole value) {
    put_whole(place, static_cast<std::int64_t>(value));
  }

  struct Finalize {
    void operator()(void* statement) const;
  };
  const Database* database_;
  std::unique_ptr<void, Finalize> handle_;  // sqlite3_stmt
};

// Everything between here and commit() is written, or nothing is.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace liana::archive
