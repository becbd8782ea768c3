#include "host/storage/archive/database.hpp"
#include "host/base/file/in_file.hpp"

#include <sqlite3.h>

namespace liana::archive {
namespace {

sqlite3* connection(void* handle) { return static_cast<sqlite3*>(handle); }
sqlite3_stmt* prepared(void* handle) { return static_cast<sqlite3_stmt*>(handle); }

constexpr int kPatience_ms = 5000;  // of a reader, while a writer tidies up

bool takes_no_more(int code) { return (code & 0xFF) == SQLITE_FULL || code == SQLITE_IOERR_WRITE; }

int flags_of(Database::Open how) {
  return how == Database::Open::kRead ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
}

}  // namespace

void Database::Close::operator()(void* database) const { sqlite3_close(connection(database)); }

Database::Database(const std::string& path, Open how) : path_(path) {
  file::require_ordinary(path);
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &opened, flags_of(how), nullptr);
  handle_.reset(opened);
  if (opened == nullptr) throw DatabaseError(path + ": no memory", false);
  check(code);
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, kPatience_ms);
  if (how == Open::kRead) {
    require_own_tables();
    return;
  }
  if (how == Open::kQuick) run("PRAGMA page_size=1024");  // a second takes 8 kB: less is left empty behind it
  run("PRAGMA journal_mode=WAL");
  run(how == Open::kDurable ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=NORMAL");
}

// A file from elsewhere has data, and no SQL that runs when it is read: a view may have rows without end, a trigger or
// a generated column computes.
void Database::require_own_tables() const {
  for (const int option : {SQLITE_DBCONFIG_DEFENSIVE, SQLITE_DBCONFIG_TRUSTED_SCHEMA})
    sqlite3_db_config(connection(handle_.get()), option, option == SQLITE_DBCONFIG_DEFENSIVE ? 1 : 0, nullptr);
  Statement other(*this,
                  "SELECT type, name FROM sqlite_schema WHERE type NOT IN ('table', 'index') OR rootpage < 1 "
                  "UNION SELECT 'generated column', t.name || '.' || c.name FROM sqlite_schema t, "
                  "pragma_table_xinfo(t.name) c WHERE t.type = 'table' AND c.hidden <> 0 LIMIT 1");
  if (other.step())
    throw DatabaseError(path_ + ": holds the " + other.text(0) + " '" + other.text(1) +
                            "'; an archive holds plain tables only: take the file that Liana wrote",
                        false);
}

void Database::refuse() const {
  throw DatabaseError(path_ + ": " + sqlite3_errmsg(connection(handle_.get())),
                      takes_no_more(sqlite3_extended_errcode(connection(handle_.get()))));
}

void Database::check(int code) const {
  if (code != SQLITE_OK) refuse();
}

void Database::run(const std::string& sql) {
  check(sqlite3_exec(connection(handle_.get()), sql.c_str(), nullptr, nullptr, nullptr));
}

void Database::finish() {
  try {
    sqlite3_busy_timeout(connection(handle_.get()), 0);
    run("PRAGMA journal_mode=DELETE");
  } catch (const DatabaseError&) {
    // it stays as it is, and can be read as well
  }
}

std::string Database::problem(bool quick) const {
  try {
    Statement check(*this, quick ? "PRAGMA quick_check(1)" : "PRAGMA integrity_check(1)");
    if (!check.step()) return path_ + ": not checked";
    const std::string found = check.text(0);
    return found == "ok" ? "" : path_ + ": " + found;
  } catch (const DatabaseError& error) {
    return error.what();
  }
}

void Statement::Finalize::operator()(void* statement) const { sqlite3_finalize(prepared(statement)); }

Statement::Statement(const Database& database, const std::string& sql) : database_(&database) {
  sqlite3_stmt* made = nullptr;
  database.check(sqlite3_prepare_v2(connection(database.handle_.get()), sql.c_str(), -1, &made, nullptr));
  handle_.reset(made);
}

void Statement::reset() { sqlite3_reset(prepared(handle_.get())); }

void Statement::run_row(const std::vector<double>& values) {
  reset();
  for (std::size_t i = 0; i < values.size(); ++i) put(static_cast<int>(i) + 1, values[i]);
  while (step()) {
  }
}

bool Statement::step() {
  const int code = sqlite3_step(prepared(handle_.get()));
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) {
    reset();
    database_->refuse();
  }
  reset();  // or it would hold the transaction open
  return false;
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(prepared(handle_.get()), column) == SQLITE_NULL;
}
std::int64_t Statement::whole(int column) const { return sqlite3_column_int64(prepared(handle_.get()), column); }
double Statement::real(int column) const { return sqlite3_column_double(prepared(handle_.get()), column); }

std::string Statement::text(int column) const {
  const void* bytes = sqlite3_column_blob(prepared(handle_.get()), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(prepared(handle_.get()), column));
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

void Statement::put(int place, std::nullptr_t) { database_->check(sqlite3_bind_null(prepared(handle_.get()), place)); }
void Statement::put_whole(int place, std::int64_t value) {
  database_->check(sqlite3_bind_int64(prepared(handle_.get()), place, value));
}
void Statement::put(int place, double value) {
  database_->check(sqlite3_bind_double(prepared(handle_.get()), place, value));
}
void Statement::put(int place, std::string_view text) {
  const auto size = static_cast<sqlite3_uint64>(text.size());
  database_->check(
      sqlite3_bind_text64(prepared(handle_.get()), place, text.data(), size, SQLITE_TRANSIENT, SQLITE_UTF8));
}
void Statement::put(int place, Blob blob) {
  const auto size = static_cast<sqlite3_uint64>(blob.bytes.size());
  database_->check(sqlite3_bind_blob64(prepared(handle_.get()), place, blob.bytes.data(), size, SQLITE_TRANSIENT));
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const DatabaseError&) {
    // what failed before has rolled it back
  }
}

}  // namespace liana::archive
