#include "sim/cli/tasks/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "sim/cli/command_line/usage_error.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const fs::path& path, const std::error_code& error) {
  throw EnvironmentError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
}

std::error_code LastError() { return {errno != 0 ? errno : EIO, std::generic_category()}; }

fs::path FolderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void RefuseInputs(const fs::path& file) {
  if (!IsInput(file)) return;
  throw UsageError(fmt::format(
      "{}: not written, since this command has read it; allowed: another file", file.string()));
}

// Returns the status of the file that the path leads to, if the file exists.
std::optional<struct stat> StatusOf(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return status;
}

// Returns which of the program's own streams the file is, if any.
std::optional<int> StreamOf(const struct stat& file) {
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat status {};
    const bool is_open = fstat(stream, &status) == 0;
    if (is_open && status.st_dev == file.st_dev && status.st_ino == file.st_ino) return stream;
  }
  return std::nullopt;
}

// Follows links, so that the rename replaces the file and not the link. The file itself need not
// exist.
fs::path Resolved(fs::path file) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int links = 0; links < kMostLinks && fs::is_symlink(fs::symlink_status(file, error));
       ++links)
    file = FolderOf(file) / fs::read_symlink(file, error);
  return file;
}

// An open file that is closed by the destructor.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, mode_t mode, const fs::path& named)
      : named_(named), number_(open(path.c_str(), flags | O_CLOEXEC, mode)) {
    if (number_ < 0) Fail(named_, LastError());
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

  // Brings the file to the disk. An error is ignored if the file has no disk, as a pipe has none.
  void Sync() const {
    if (fsync(number_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) {
      Fail(named_, LastError());
    }
  }
  // Closes the file. Some file systems report only now that there is no room.
  void Close() {
    const int number = std::exchange(number_, -1);
    if (close(number) != 0) Fail(named_, LastError());
  }

 private:
  const fs::path& named_;  // path for messages
  int number_;
};

void WriteInto(int descriptor, std::string_view text, const fs::path& named) {
  while (!text.empty()) {
    errno = 0;
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) Fail(named, LastError());
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

// A hidden, empty file beside another, with the same ending and permissions. It is removed unless
// it took the other's place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& file) : path_(NameBeside(file)) {
    Descriptor created(path_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0666, file);
    if (const auto old = StatusOf(file)) fchmod(created.number(), old->st_mode & 07777);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return path_; }

  void Replace(const fs::path& file) const {
    Descriptor(path_, O_RDONLY, 0, file).Sync();
    std::error_code error;
    fs::rename(path_, file, error);
    if (error) Fail(file, error);
    Descriptor(FolderOf(file), O_RDONLY | O_DIRECTORY, 0, file).Sync();
  }

 private:
  // The process id distinguishes two programs, the count two threads.
  static fs::path NameBeside(const fs::path& file) {
    static std::atomic<int> count = 0;
    return FolderOf(file) /
           fmt::format(".assay-{}-{}{}", getpid(), ++count, file.extension().string());
  }

  const fs::path path_;
};

// Writes the text into a file that a rename cannot replace, such as a device. Returns whether the
// file was of this kind.
bool WriteThrough(const fs::path& file, std::string_view text) {
  const std::optional<struct stat> status = StatusOf(file);
  if (!status || S_ISDIR(status->st_mode)) return false;
  std::fflush(nullptr);  // earlier output comes first
  if (S_ISREG(status->st_mode)) {
    const std::optional<int> stream = StreamOf(*status);
    if (stream) WriteInto(*stream, text, file);
    return stream.has_value();
  }
  Descriptor device(file, O_WRONLY, 0, file);
  WriteInto(device.number(), text, file);
  device.Close();
  return true;
}

}  // namespace

void RequireWritable(const fs::path& file) {
  if (file.empty()) return;
  RefuseInputs(file);
  RequireAmendable(file);
}

void RequireAmendable(const fs::path& file) {
  const std::optional<struct stat> status = StatusOf(file);
  if (status && S_ISDIR(status->st_mode))
    Fail(file, std::make_error_code(std::errc::is_a_directory));
  if (status && access(file.c_str(), W_OK) != 0) Fail(file, LastError());
  if (status && !S_ISREG(status->st_mode)) return;
  const fs::path folder = FolderOf(Resolved(file));
  const std::optional<struct stat> around = StatusOf(folder);
  if (around && !S_ISDIR(around->st_mode)) {
    Fail(file, std::make_error_code(std::errc::not_a_directory));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) Fail(file, LastError());
}

void WriteFile(const fs::path& file, std::string_view text) {
  RefuseInputs(file);
  AmendFile(file, text);
}

void AmendFile(const fs::path& file, std::string_view text) {
  if (WriteThrough(file, text)) return;
  const fs::path target = Resolved(file);
  const TemporaryFile temporary(target);
  Descriptor out(temporary.path(), O_WRONLY | O_TRUNC, 0, file);
  WriteInto(out.number(), text, file);
  out.Close();
  temporary.Replace(target);
}

void WriteFileBy(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  RefuseInputs(file);
  const fs::path target = Resolved(file);
  const TemporaryFile temporary(target);
  write(temporary.path());
  temporary.Replace(target);
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) Fail(folder, error);
  RequireWritable(folder / "file");
}

}  // namespace assay::cli
