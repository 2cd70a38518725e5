#include "sim/cli/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "planner/base/input_error.h"

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

// A device or a pipe cannot be replaced by a rename: it is written into.
bool IsStream(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) && !fs::is_regular_file(file, ignored) &&
         !fs::is_directory(file, ignored);
}

// Where a link leads, so that the rename replaces the file and not the link.
fs::path Resolved(const fs::path& file) {
  std::error_code error;
  const fs::path resolved = fs::canonical(file, error);
  return error ? file : resolved;
}

// Beside the file, hidden, with its ending; the process id keeps two programs apart.
fs::path TemporaryName(const fs::path& file) {
  return FolderOf(file) /
         fmt::format(".{}.{}{}", file.stem().string(), getpid(), file.extension().string());
}

void WriteText(const fs::path& file, std::string_view text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) Fail(file, LastError());
}

// Removes the temporary file if it was not renamed.
struct TemporaryFile {
  fs::path path;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

}  // namespace

void RequireWritable(const fs::path& file) {
  if (file.empty() || IsStream(file)) return;
  std::error_code error;
  if (fs::is_directory(file, error)) {
    Fail(file, std::make_error_code(std::errc::is_a_directory));
  }
  const fs::path folder = FolderOf(file);
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    Fail(file, std::make_error_code(std::errc::not_a_directory));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) Fail(file, LastError());
}

void WriteFileBy(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  if (IsStream(file)) return write(file);
  const fs::path target = Resolved(file);
  const TemporaryFile temporary{TemporaryName(target)};
  write(temporary.path);
  std::error_code error;
  fs::rename(temporary.path, target, error);
  if (error) Fail(file, error);
}

void WriteFile(const fs::path& file, std::string_view text) {
  WriteFileBy(file, [&](const fs::path& path) { WriteText(path, text); });
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) Fail(folder, error);
  RequireWritable(folder / "file");
}

}  // namespace assay::cli
