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

// A prepared statement of a database that outlives it. Parameters and columns count from 0.
class Statement {
 public:
  // Binds all parameters, in order; checked that there are as many.
  template <class... Values>
  Statement& Bind(const Values&... values) {
    Begin(sizeof...(values));
    int parameter = 0;
    (BindOne(parameter++, values), ...);
    return *this;
  }
  bool Next();  // to the next row; false: there is none, and the statement can be bound again
  void Run();   // a statement without rows

  std::int64_t Integer(int column) const;
  int Int(int column) const;      // throws InputError if it is none
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

// An SQLite database: owns its handle. Whatever fails names the file and the remedy: an InputError
// where the file is no database or a damaged one, else an EnvironmentError (no room, no permission,
// somebody else writes into it).
class Database {
 public:
  enum class Access { kRead, kWrite };

  // For kWrite the file is made if there is none, and no other Database, of any program, may write
  // into it while this one lives; readers come and go.
  Database(const std::filesystem::path& file, Access access);

  const std::filesystem::path& file() const { return file_; }

  void Execute(const std::string& sql);  // any number of statements, whose rows do not matter
  Statement Prepare(std::string_view sql) const;
  std::int64_t Integer(std::string_view sql) const;  // the one value of a query
  bool InTransaction() const;

  // Throws what this error code of the last call comes to.
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
  // Closed after the handle: closing any stream of a file lets go of SQLite's own locks on it.
  std::unique_ptr<std::FILE, FileCloser> lock_;
  std::unique_ptr<sqlite3, Closer> handle_;
};

// All that is written between its start and Commit is there as a whole, or not at all.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();  // without a commit: nothing was written
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void Commit();

 private:
  Database& database_;
};

}  // namespace assay::sweep
