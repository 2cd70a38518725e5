#include "planner/base/input_files/input_file.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "planner/base/digest.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/nearest_name.h"
#include "planner/base/input_files/quotation.h"

namespace assay {
namespace {

namespace fs = std::filesystem;

// Identifies a file independently of the links to it.
using FileId = std::pair<dev_t, ino_t>;

struct ReadFiles {
  std::mutex mutex;
  std::set<FileId> ids;
  std::set<fs::path> paths;  // canonical; needed if another program has replaced a file since
};

ReadFiles& Files() {
  static ReadFiles files;
  return files;
}

thread_local FilesRead* collecting = nullptr;  // the innermost one of this thread

// Terminals, pipes and devices are excluded, because overwriting them loses no input.
bool IsRegular(const fs::path& file, struct stat& status) {
  return stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

fs::path Canonical(const fs::path& file) {
  std::error_code ignored;
  return fs::canonical(file, ignored);
}

std::string NearestInFolder(const fs::path& file) {
  constexpr std::size_t kMostNames = 10'000;
  std::vector<std::string> names;
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (names.size() == kMostNames) break;
    names.push_back(entry->path().filename().string());
  }
  std::ranges::sort(names);
  const std::string nearest = NearestName(file.filename().string(), names);
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", Quote(nearest));
}

// Tests what YAML calls printable. NUL is not printable, so binary files and UTF-16 are excluded.
bool IsPrintable(char32_t c) {
  return c == U'\t' || c == U'\n' || c == U'\r' || c == 0x85 || (!IsControl(c) && c < 0xfffe) ||
         c >= 0x10000;
}

}  // namespace

std::string ReadInput(const fs::path& file, std::string_view allowed, std::size_t most) {
  const FilePlace place{.file = file.string()};
  const std::string wanted(allowed);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    throw InputError(place, "no such file" + NearestInFolder(file), wanted);
  }
  if (error) throw InputError(place, "cannot be read: " + error.message(), wanted);
  if (fs::is_directory(status)) throw InputError(place, "is a directory", wanted);
  // A device may have no end.
  if (!fs::is_regular_file(status)) most = std::min(most, kMostInputBytes);
  const auto require_size = [&](std::uintmax_t size) {
    if (size > most) {
      throw InputError(place, "the file is too large", fmt::format("{} bytes", most));
    }
  };
  if (fs::is_regular_file(status)) require_size(fs::file_size(file, error));
  std::ifstream in(file, std::ios::binary);
  std::string text;
  std::vector<char> block(std::size_t{1} << 16);
  while (in && text.size() <= most) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad() || !in.is_open()) throw InputError(place, "cannot be read", wanted);
  require_size(text.size());
  RememberInput(file);
  if (collecting != nullptr) collecting->Add(Canonical(file), Digest().Add(text).Hex());
  return text;
}

void RememberInput(const fs::path& file) {
  struct stat status {};
  if (!IsRegular(file, status)) return;
  ReadFiles& files = Files();
  const std::lock_guard lock(files.mutex);
  files.ids.emplace(status.st_dev, status.st_ino);
  files.paths.insert(Canonical(file));
}

bool IsInput(const fs::path& file) {
  struct stat status {};
  if (!IsRegular(file, status)) return false;
  ReadFiles& files = Files();
  const std::lock_guard lock(files.mutex);
  return files.ids.contains({status.st_dev, status.st_ino}) ||
         files.paths.contains(Canonical(file));
}

FilesRead::FilesRead() : outer_(std::exchange(collecting, this)) {}

FilesRead::~FilesRead() { collecting = outer_; }

void FilesRead::Add(const fs::path& file, const std::string& digest) {
  digests_[file] = digest;
  if (outer_ != nullptr) outer_->Add(file, digest);
}

std::string FilesRead::Digest() const {
  std::vector<std::pair<std::string, std::string>> contents;  // by name
  for (const auto& [path, digest] : digests_) {
    contents.emplace_back(path.filename().string(), digest);
  }
  std::ranges::sort(contents);
  assay::Digest all;
  for (const auto& [name, digest] : contents) all.Add(name).Add(digest);
  return all.Hex();
}

void RequireText(std::string_view text, const std::string& file_name) {
  FilePlace place{.file = file_name, .line = 1, .column = 1};
  const auto is_plain = [](char c) { return c >= 0x20 && c < 0x7f; };  // true for most characters
  while (true) {
    const auto plain = std::ranges::find_if_not(text, is_plain) - text.begin();
    place.column += static_cast<int>(plain);
    text.remove_prefix(static_cast<std::size_t>(plain));
    if (text.empty()) return;
    const CodePoint c = Decode(text);
    if (c.bytes == 0 || !IsPrintable(c.value)) {
      throw InputError(place,
                       fmt::format("the byte 0x{:02x} is not part of a text",
                                   static_cast<unsigned char>(text[0])),
                       "UTF-8 without control characters");
    }
    place.column = c.value == U'\n' ? 1 : place.column + static_cast<int>(c.bytes);
    place.line += c.value == U'\n' ? 1 : 0;
    text.remove_prefix(c.bytes);
  }
}

}  // namespace assay
