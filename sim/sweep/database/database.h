#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace assay::sweep {

class Database;

// A prepared statement. The database must outlive it. Parameters and columns are numbered from 0.
class Statement {
 public:
  // Binds all parameters in order. Their number must agree with the statement (checked).
  template <class... Values>
  Statement& Bind(const Values&... values) {
    Begin(sizeof...(values));
    int parameter = 0;
    (BindOne(parameter++, values), ...);
    return *this;
  }
  // Goes to the next row. Returns false if there is none; then the statement can be bound again.
  bool Next();
  void Run();  // executes a statement without rows

  std::int64_t Integer(int column) const;
  int Int(int column) const;      // throws InputError if the value does not fit an int
  double Real(int column) const;  // NULL is NaN
  std::string Text(int column) const;

 private:
  friend class Database;
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement(const Database& database, std::string_view sql);

  void Begin(std::size_t parameters);
  void BindOne(int parameter, std::int64_t value);
  void BindOne(int parameter, int value) { BindOne(parameter, std::int64_t{value}); }
  void BindOne(int parameter, bool value) { BindOne(parameter, std::int64_t{value}); }
  void BindOne(int parameter, double value);  // NaN is NULL
  void BindOne(int parameter, std::string_view value);

  const Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
};

// An SQLite database, which owns its handle. Errors name the file and the remedy. An InputError
// means that the file is no database or a damaged one. An EnvironmentError means anything else: no
// room on the disk, no permission, or another program that writes into the file.
class Database {
 public:
  enum class Access { kRead, kWrite };

  // Opens the file. With kWrite the file is made if there is none. No other Database of any program
  // may write into it while this one lives, but others may read it.
  Database(const std::filesystem::path& file, Access access);

  const std::filesystem::path& file() const { return file_; }

  void Execute(const std::string& sql);  // executes any number of statements and ignores their rows
  Statement Prepare(std::string_view sql) const;
  std::int64_t Integer(std::string_view sql) const;  // returns the only value of a query
  bool InTransaction() const;

  // Throws the error that belongs to this error code of the last call.
  [[noreturn]] void Fail(int code) const;

 private:
  friend class Statement;
  struct Closer {
    void operator()(sqlite3* handle) const;
  };
  struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void KeepOtherWritersOut();

  std::filesystem::path file_;
  // Must be closed after the handle, because closing any stream of a file releases SQLite's own
  // locks on it.
  std::unique_ptr<std::FILE, FileCloser> lock_;
  std::unique_ptr<sqlite3, Closer> handle_;
};

// Everything that is written between the start of a transaction and Commit is stored as a whole, or
// not at all.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();  // without a commit nothing was written
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void Commit();

 private:
  Database& database_;
};

}  // namespace assay::sweep
