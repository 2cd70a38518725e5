#include "sim/sweep/database/database.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/file.h>

#include <cerrno>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "planner/base/check.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"

namespace assay::sweep {
namespace {

// The greatest time to wait while another program locks the file.
constexpr int kPatienceMilliseconds = 10'000;

std::string SystemWords(int error) {
  return error == 0 ? "" : fmt::format(" ({})", std::generic_category().message(error));
}

// Returns what is wrong and what the user can do about it.
std::string Trouble(int code, const char* words, int system_error) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return "there is no room left to write it; what was written before is kept: make room, then "
             "go on with --resume";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "it is read-only; copy it to where it may be written, or change its permissions";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "it is locked by another program; wait until that has ended";
    case SQLITE_CANTOPEN:
      return fmt::format("it cannot be opened{}; its folder must exist and be writable",
                         SystemWords(system_error));
    case SQLITE_IOERR:
      return fmt::format(
          "it cannot be read or written{}; what was written before is kept: mend that, then go on "
          "with --resume",
          SystemWords(system_error));
    case SQLITE_CONSTRAINT:
      // Keys are numbers of trials, so a conflict means that a trial is stored already.
      return fmt::format(
          "the database already contains this trial or plan ({}); is another program doing the "
          "same sweep?",
          words);
    default:
      return words;
  }
}

}  // namespace

void Statement::Finalizer::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(const Database& database, std::string_view sql) : database_(&database) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database.handle_.get(), sql.data(),
                                      static_cast<int>(sql.size()), &statement, nullptr);
  statement_.reset(statement);
  if (code != SQLITE_OK) database.Fail(code);
}

void Statement::Begin(std::size_t parameters) {
  // The result is ignored, because a failure of the last use was reported by that use.
  sqlite3_reset(statement_.get());
  ASSAY_CHECK(sqlite3_bind_parameter_count(statement_.get()) == static_cast<int>(parameters),
              "{} values for: {}", parameters, sqlite3_sql(statement_.get()));
}

void Statement::BindOne(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), parameter + 1, value);
}

void Statement::BindOne(int parameter, double value) {
  sqlite3_bind_double(statement_.get(), parameter + 1, value);
}

void Statement::BindOne(int parameter, std::string_view value) {
  sqlite3_bind_text64(statement_.get(), parameter + 1, value.data() == nullptr ? "" : value.data(),
                      value.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
}

bool Statement::Next() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_->Fail(code);
  sqlite3_reset(statement_.get());
  return false;
}

void Statement::Run() {
  const bool has_row = Next();
  ASSAY_CHECK(!has_row, "rows from: {}", sqlite3_sql(statement_.get()));
}

std::int64_t Statement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

int Statement::Int(int column) const {
  const std::int64_t value = Integer(column);
  if (std::in_range<int>(value)) return static_cast<int>(value);
  throw InputError(
      {.file = database_->file().string()},
      fmt::format("{} is {}", sqlite3_column_name(statement_.get(), column), value),
      fmt::format("{} to {}", std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}

double Statement::Real(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sqlite3_column_double(statement_.get(), column);
}

std::string Statement::Text(int column) const {
  const auto* const text =
      reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return text == nullptr ? "" : std::string(text, sqlite3_column_bytes(statement_.get(), column));
}

void Database::Closer::operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }

// The path is made absolute, because SQLite takes names that begin with a colon for databases in
// memory.
Database::Database(const std::filesystem::path& file, Access access) : file_(file) {
  const int flags =
      access == Access::kRead ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(std::filesystem::absolute(file).c_str(), &handle,
                                   flags | SQLITE_OPEN_EXRESCODE, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) Fail(code);
  sqlite3_busy_timeout(handle, kPatienceMilliseconds);
  if (access == Access::kWrite && sqlite3_db_readonly(handle, "main") == 1) Fail(SQLITE_READONLY);
  if (access == Access::kWrite) KeepOtherWritersOut();
  if (access == Access::kRead) RememberInput(file);
}

// The operating system releases the lock when the program ends, however it ends. If the file system
// has no locks, the transactions of SQLite still exclude each other.
void Database::KeepOtherWritersOut() {
  lock_.reset(std::fopen(file_.c_str(), "re"));
  if (lock_ != nullptr && flock(fileno(lock_.get()), LOCK_EX | LOCK_NB) != 0 &&
      errno == EWOULDBLOCK) {
    Fail(SQLITE_LOCKED);
  }
}

void Database::Execute(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) Fail(code);
}

Statement Database::Prepare(std::string_view sql) const { return {*this, sql}; }

std::int64_t Database::Integer(std::string_view sql) const {
  Statement query = Prepare(sql);
  const bool has_row = query.Next();
  ASSAY_CHECK(has_row, "no row from: {}", sql);
  return query.Integer(0);
}

bool Database::InTransaction() const { return sqlite3_get_autocommit(handle_.get()) == 0; }

void Database::Fail(int code) const {
  const int kind = code & 0xff;
  if (kind == SQLITE_NOTADB) {
    throw InputError({.file = file_.string()}, "not a database",
                     "a database that assay sweep has written");
  }
  // SQLite reports a damaged list of tables as an error of the query (SQLITE_ERROR).
  if (kind == SQLITE_CORRUPT || kind == SQLITE_ERROR) {
    throw InputError({.file = file_.string()},
                     fmt::format("the database is damaged ({})", sqlite3_errmsg(handle_.get())),
                     "an undamaged one; sqlite3's .recover saves what can be read");
  }
  throw EnvironmentError(fmt::format(
      "{}: {}", file_.string(),
      Trouble(code, sqlite3_errmsg(handle_.get()), sqlite3_system_errno(handle_.get()))));
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.Execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  // SQLite has rolled back itself if the disk is full.
  if (!database_.InTransaction()) return;
  try {
    database_.Execute("ROLLBACK");
  } catch (const std::runtime_error&) {
    // The error can be ignored: the handle is closed next, or the next transaction reports it.
  }
}

void Transaction::Commit() { database_.Execute("COMMIT"); }

}  // namespace assay::sweep
